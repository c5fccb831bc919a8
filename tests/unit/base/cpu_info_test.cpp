#include "harness/base/cpu_info.h"

#include <gtest/gtest.h>

using namespace crossray;

TEST(CpuInfo, isVendorAndModelOfTheFirstProcessor)
{
    EXPECT_EQ(parseCpuInfo("processor\t: 0\nvendor_id\t: AuthenticAMD\nmodel\t\t: 1\nmodel name\t: AMD EPYC   7B13 \n\n"
                           "processor\t: 1\nvendor_id\t: GenuineIntel\nmodel name\t: other\n"),
              "AuthenticAMD AMD EPYC 7B13");
}

TEST(CpuInfo, namesTheArmImplementerWhereThereIsNoVendor)
{
    EXPECT_EQ(parseCpuInfo("processor : 0\nCPU implementer : 0x41\nCPU part : 0xd0c\n"),
              "ARM implementer 0x41 part 0xd0c");
}

TEST(CpuInfo, isUnknownWhenTheTextSaysNothing)
{
    EXPECT_EQ(parseCpuInfo(""), "unknown");
    EXPECT_EQ(parseCpuInfo("no colon here\nmodel name without colon"), "unknown");
    EXPECT_EQ(parseCpuInfo("vendor_id : X"), "X"); // the last line may lack its end
}

TEST(CpuInfo, ofThisMachineIsOneLine)
{
    const std::string text = readCpuInfo();
    EXPECT_FALSE(text.empty());
    EXPECT_EQ(text.find('\n'), std::string::npos);
}
