#include "harness/base/error.h"

#include <gtest/gtest.h>

using namespace crossray;

TEST(SourcePosition, isShortenedByWhatIsUnknown)
{
    EXPECT_EQ((SourcePosition{"a.toml", 3, 7}.format()), "a.toml:3:7");
    EXPECT_EQ((SourcePosition{"a.toml", 3, 0}.format()), "a.toml:3");
    EXPECT_EQ((SourcePosition{"a.toml", 0, 0}.format()), "a.toml");
    EXPECT_EQ((SourcePosition{}.format()), "");
}

TEST(Error, isOneLineThatOpensWithThePosition)
{
    const InputError error({"case.toml", 2, 5}, "unknown key \"iro\"");
    EXPECT_STREQ(error.what(), "case.toml:2:5: unknown key \"iro\"");
    EXPECT_EQ(error.exitCode(), ExitCode::kUsage);
    EXPECT_STREQ(InputError("no shape \"pl\r\n\te\x7f\"").what(), "no shape \"pl   e \"");
    EXPECT_EQ(EnvironmentError("no device").exitCode(), ExitCode::kEnvironment);
}
