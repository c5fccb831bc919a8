// What a device keeps from job to job, and what it lets go.
#include "harness/backend/gl/gl_context.h"
#include "harness/backend/gl/gl_debug.h"
#include "harness/backend/gl/gl_fingerprint.h"
#include "harness/backend/gl/lru_cache.h"
#include "tests/unit/backend_gl/gl_test_device.h"

#include <chrono>
#include <fstream>
#include <unistd.h>

using namespace crossray;

namespace {

size_t readResidentBytes()
{
    std::ifstream file("/proc/self/statm");
    size_t total = 0, resident = 0;
    file >> total >> resident;
    return resident * static_cast<size_t>(sysconf(_SC_PAGESIZE));
}

} // namespace

TEST(LruCache, dropsTheLeastRecentlyUsed)
{
    LruCache<int> cache;
    cache.insert("a", 1);
    cache.insert("b", 2);
    cache.insert("c", 3);
    EXPECT_EQ(*cache.find("a"), 1);
    cache.trim(2);
    EXPECT_EQ(cache.size(), 2u);
    EXPECT_EQ(cache.find("b"), nullptr);
    EXPECT_EQ(*cache.find("a"), 1);
    EXPECT_EQ(*cache.find("c"), 3);
    EXPECT_EQ(cache.find("d"), nullptr);
}

using GlLifetime = GlTest;

TEST_F(GlLifetime, keeps512Programs)
{
    const auto makePrograms = [](int from, int to) {
        Job job;
        for (int number = from; number < to; ++number)
            job.programs.push_back(makeProgram(makeGlsl(fmt::format("result[0] = {}.0;", number))));
        return job;
    };
    EXPECT_FALSE(run(makePrograms(0, 512)).programsWereWarm);
    EXPECT_TRUE(run(makePrograms(0, 512)).programsWereWarm);
    EXPECT_TRUE(run(makePrograms(0, 1)).programsWereWarm);
    EXPECT_FALSE(run(makePrograms(512, 513)).programsWereWarm); // drops number 1, which was used the longest ago
    EXPECT_TRUE(run(makePrograms(0, 1)).programsWereWarm);
    EXPECT_TRUE(run(makePrograms(2, 513)).programsWereWarm);
    EXPECT_FALSE(run(makePrograms(1, 2)).programsWereWarm);
}

TEST_F(GlLifetime, programsWithoutAKeyAreToldApartByTheirText)
{
    for (const double value : {1.0, 2.0}) {
        Job job = makeJob(makeGlsl(fmt::format("result[0] = {:.1f};", value)), 1);
        job.programs[0].key.clear();
        EXPECT_EQ(run(job).readbacks[0][0], value);
    }
}

TEST_F(GlLifetime, memoryDoesNotGrowOverAThousandJobs)
{
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer keeps freed memory; it looks for leaks by itself";
#endif
    Job job = makeJob(makeGlsl("result[gl_GlobalInvocationID.x] = texelFetch(image, ivec2(0), 0).x;",
                               "layout(binding = 1) uniform sampler2D image;"),
                      4096);
    job.dispatches[0].bindings.push_back(bindImage(1, 0));
    job.images.resize(1);
    size_t before = 0;
    for (int round = 0; round < 1200; ++round) {
        if (round == 600) before = readResidentBytes();
        // No shape comes twice, and by now the pool is full: it has to let go as much as it takes.
        ImageDesc& image = job.images[0];
        image.width = 64 + round;
        image.height = 64;
        image.texels.assign(static_cast<size_t>(image.width) * 64, 0.5);
        job.buffers[0].scalarCount = static_cast<size_t>(4096 + 64 * round);
        ASSERT_EQ(run(job).readbacks[0][0], 0.5);
    }
    EXPECT_LT(readResidentBytes(), before + (size_t{16} << 20));
}

TEST_F(GlLifetime, devicesFollowEachOther)
{
    const Job job = makeJob(makeGlsl("result[0] = 3.0;"), 1);
    const auto second = makeGlDevice(testBackend(), {});
    EXPECT_EQ(run(job).readbacks[0][0], 3.0);
    EXPECT_EQ(second->run(job).readbacks[0][0], 3.0);
    EXPECT_EQ(run(job).readbacks[0][0], 3.0);
    device_.reset();
    EXPECT_EQ(second->run(job).readbacks[0][0], 3.0);
}

TEST_F(GlLifetime, debugMessagesAreCaught)
{
    // The device's context is current; a second log takes its place.
    GlDebugLog log;
    glBindBuffer(GL_TEXTURE_2D, 0);
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_PORTABILITY, 1, GL_DEBUG_SEVERITY_MEDIUM, -1,
                         "a word\n");
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_OTHER, 2, GL_DEBUG_SEVERITY_NOTIFICATION, -1,
                         "chat");
    const auto messages = log.take();
    ASSERT_EQ(messages.size(), 2u);
    EXPECT_EQ(messages[0].find("OpenGL API error (high): GL_INVALID_ENUM"), 0u) << messages[0];
    EXPECT_EQ(messages[1], "OpenGL application portability (medium): a word");
    EXPECT_TRUE(log.take().empty());
}

// Without its empty indirect buffer, which only the preparation of a new program reads, a device makes one API error.
TEST_F(GlLifetime, anErrorOfTheApiIsAMessageOfItsJob)
{
    const Job job = makeJob(makeGlsl("result[0] = 5.0;"), 1);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    const JobResult result = device_->run(job);
    ASSERT_EQ(result.messages.size(), 2u);
    EXPECT_EQ(result.messages[0].find("OpenGL API error (high): GL_INVALID_OPERATION"), 0u) << result.messages[0];
    EXPECT_EQ(result.messages[1], "OpenGL error 0x0502");
    EXPECT_TRUE(device_->run(job).messages.empty());

    const auto plain = makeGlDevice(testBackend(), {});
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    EXPECT_EQ(plain->run(job).messages, std::vector<std::string>{"OpenGL error 0x0502"});
}

TEST_F(GlLifetime, warningsOfTheCompilerAreNoMessages)
{
    const auto seed = std::chrono::steady_clock::now().time_since_epoch().count() % 1000000;
    run(makeJob(makeGlsl(fmt::format("float x;\nresult[0] = x + {}.0;", seed)), 1)); // x is used uninitialised
}

TEST_F(GlLifetime, theFingerprintNamesTheDriver)
{
    const Fingerprint print = device_->fingerprint();
    EXPECT_EQ(print.backend, testBackend());
    EXPECT_EQ(print.api.find("OpenGL 4."), 0u) << print.api;
    EXPECT_FALSE(print.device.empty());
    EXPECT_FALSE(print.driver.empty());
    EXPECT_FALSE(print.cpu.empty());
    EXPECT_EQ(print.llvm.empty(), !isRenderer("LLVM")) << print.device;
    EXPECT_EQ(device_->precision(), Precision::kFloat);
}

TEST_F(GlLifetime, oneProcessOpensOneBackend)
{
    const std::string other = testBackend() == "osmesa" ? "softpipe" : "osmesa";
    EXPECT_EQ(catchError<EnvironmentError>([&] { makeGlDevice(other, {}); }),
              other + " cannot be opened in a process that has opened " + testBackend());
}

TEST(GlFingerprint, isReadFromTheDriversStrings)
{
    const Fingerprint mesa =
        parseGlFingerprint("osmesa", "4.5 (Core Profile) Mesa 22.3.6", "llvmpipe (LLVM 15.0.6, 256 bits)");
    EXPECT_EQ(mesa.api, "OpenGL 4.5 core");
    EXPECT_EQ(mesa.device, "llvmpipe (LLVM 15.0.6, 256 bits)");
    EXPECT_EQ(mesa.driver, "Mesa 22.3.6");
    EXPECT_EQ(mesa.llvm, "15.0.6");
    const Fingerprint other = parseGlFingerprint("egl", "4.6.0 NVIDIA 535.54", "NVIDIA H100");
    EXPECT_EQ(other.driver, "4.6.0 NVIDIA 535.54");
    EXPECT_EQ(other.llvm, "");
}

TEST(GlOpening, anUnknownNameIsRefused)
{
    EXPECT_EQ(catchError<EnvironmentError>([] { makeGlDevice("metal", {}); }),
              "\"metal\" is no OpenGL backend: osmesa, softpipe and egl are");
}

TEST(GlOpening, anotherDriverThanPromisedIsRefused)
{
    if (testBackend() == "egl") GTEST_SKIP() << "egl promises no driver";
    // In a process of its own, since a process opens one backend.
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    const std::string other = testBackend() == "osmesa" ? "softpipe" : "osmesa";
    const auto open = [&] {
        std::fputs(catchError<EnvironmentError>([&] { makeGlDevice(other, {}); }).c_str(), stderr);
        std::exit(0);
    };
    EXPECT_EXIT(open(), testing::ExitedWithCode(0), other + " promises the driver ");
}
