#include "harness/base/hash.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

using namespace crossray;

// Published test vectors of 128-bit FNV-1a.
TEST(Hash, agreesWithThePublishedVectors)
{
    EXPECT_EQ(hashBytes("").hex(), "6c62272e07bb014262b821756295c58d");
    EXPECT_EQ(hashBytes("a").hex(), "d228cb696f1a8caf78912b704e4a8964");
    EXPECT_EQ(hashBytes("foobar").hex(), "343e1662793c64bf6f0d3597ba446f18");
}

TEST(Hash, separatesFields)
{
    EXPECT_NE(Hasher().addString("ab").addString("c").finish(), Hasher().addString("a").addString("bc").finish());
    EXPECT_NE(Hasher().addNumber(1).finish(), Hasher().addNumber(256).finish());
}

TEST(Hash, changesWithEveryBit)
{
    EXPECT_TRUE(rc::check([](std::string text) {
        RC_PRE(!text.empty());
        const size_t place = *rc::gen::inRange<size_t>(0, text.size());
        std::string other = text;
        other[place] = static_cast<char>(other[place] ^ (1 << *rc::gen::inRange(0, 8)));
        RC_ASSERT(hashBytes(text) != hashBytes(other));
    }));
}
