#include "harness/base/bytes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

using namespace crossray;

TEST(Bytes, roundTrip)
{
    EXPECT_TRUE(rc::check([](const std::string& text, const std::vector<double>& values, uint32_t number, bool flag) {
        ByteWriter writer;
        writer.putString(text);
        writer.putVector(values);
        writer.put(number);
        writer.put<uint8_t>(flag);
        const std::vector<std::byte> bytes = writer.take();
        ByteReader reader(bytes);
        RC_ASSERT(reader.getString() == text);
        RC_ASSERT(reader.getVector<double>() == values);
        RC_ASSERT(reader.get<uint32_t>() == number);
        RC_ASSERT(reader.getBool() == flag);
        reader.finish();
    }));
}

TEST(Bytes, floatsAreRoundedOnce)
{
    const std::vector<double> values{0.1, -3.0, 1e300};
    ByteWriter writer;
    writer.putAsFloats(values);
    const std::vector<std::byte> bytes = writer.take();
    EXPECT_EQ(bytes.size(), 8u + 3 * sizeof(float));
    EXPECT_EQ(ByteReader(bytes).getFloatsAsDoubles(),
              (std::vector<double>{double{0.1f}, -3.0, std::numeric_limits<double>::infinity()}));
}

TEST(Bytes, everyTruncationIsAnInputError)
{
    ByteWriter writer;
    writer.putString("name");
    writer.putVector(std::vector<uint32_t>{1, 2, 3});
    const std::vector<std::byte> bytes = writer.take();
    for (size_t size = 0; size < bytes.size(); ++size) {
        ByteReader reader(std::span<const std::byte>(bytes).first(size));
        EXPECT_THROW(
            {
                reader.getString();
                reader.getVector<uint32_t>();
            },
            InputError);
    }
}

TEST(Bytes, hugeLengthsAllocateNothing)
{
    ByteWriter writer;
    writer.put<uint64_t>(~uint64_t{0} / 2);
    const std::vector<std::byte> bytes = writer.take();
    EXPECT_THROW(ByteReader(bytes).getString(), InputError);
    EXPECT_THROW(ByteReader(bytes).getVector<double>(), InputError);
    EXPECT_THROW(ByteReader(bytes).getFloatsAsDoubles(), InputError);
}

TEST(Bytes, leftoversAndFalseFlagsAreErrors)
{
    ByteWriter writer;
    writer.put<uint8_t>(2);
    const std::vector<std::byte> bytes = writer.take();
    EXPECT_THROW(ByteReader(bytes).finish(), InputError);
    EXPECT_THROW(ByteReader(bytes).getBool(), InputError);
}
