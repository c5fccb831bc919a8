#include "harness/base/text.h"

#include "harness/base/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

using namespace crossray;

TEST(Text, FilesAreReadByteForByte)
{
    const TemporaryFolder folder("text");
    const std::string bytes("a\r\n\0b\xff", 6);
    std::ofstream(folder.path() / "some", std::ios::binary) << bytes;
    std::ofstream(folder.path() / "empty", std::ios::binary).close();
    EXPECT_EQ(readText(folder.path() / "some"), bytes);
    EXPECT_EQ(readText(folder.path() / "empty"), "");
    EXPECT_EQ(readText(folder.path() / "none"), std::nullopt);
    EXPECT_EQ(readText(folder.path()), std::nullopt) << "a folder opens, and has nothing to read";
}

TEST(Text, MarkupIsEscaped)
{
    EXPECT_EQ(escapeMarkup("a < b && \"c\" > d"), "a &lt; b &amp;&amp; &quot;c&quot; &gt; d");
}
