// What the tests of the Vulkan device share: SPIR-V from GLSL text, the choice of a driver, and small jobs.
#pragma once

#include "harness/backend/device.h"
#include "harness/backend/vulkan/vulkan_device.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <unistd.h>

namespace crossray::test {

// Compiles with the glslangValidator program and keeps the result in the build folder: each test is a process of its
// own, and the compiler takes longer than most of them.
inline std::vector<uint32_t> compileGlsl(const std::string& glsl)
{
    const std::filesystem::path folder = std::filesystem::path(CROSSRAY_BINARY_DIR) / "test_spirv";
    std::filesystem::create_directories(folder);
    const std::string name = fmt::format("{:016x}", std::hash<std::string>{}(glsl));
    const std::filesystem::path file = folder / (name + ".spv");
    if (!std::filesystem::exists(file)) {
        const std::filesystem::path own = folder / fmt::format("{}.{}", name, getpid());
        std::ofstream(own.string() + ".comp") << glsl;
        const std::string command =
            fmt::format("glslangValidator --quiet -V --target-env vulkan1.1 -o '{0}.spv' '{0}.comp'", own.string());
        if (std::system(command.c_str()) != 0) throw std::runtime_error("glslangValidator refuses:\n" + glsl);
        std::filesystem::rename(own.string() + ".spv", file);
        std::filesystem::remove(own.string() + ".comp");
    }
    std::ifstream in(file, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    std::vector<uint32_t> words(bytes.size() / sizeof(uint32_t));
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof(uint32_t));
    return words;
}

inline ProgramSource makeProgram(const std::string& entry, const std::string& glsl)
{
    ProgramSource source;
    source.entry = entry;
    source.spirv = compileGlsl("#version 450\n" + glsl);
    source.key = entry + std::to_string(std::hash<std::string>{}(glsl));
    return source;
}

inline BufferDesc makeStorage(size_t scalarCount)
{
    BufferDesc desc;
    desc.scalarCount = scalarCount;
    return desc;
}

template <typename T>
BufferDesc makeUniform(const T& content)
{
    BufferDesc desc;
    desc.kind = BufferKind::kUniform;
    desc.bytes.resize(sizeof(T));
    std::memcpy(desc.bytes.data(), &content, sizeof(T));
    return desc;
}

inline Binding bindBuffer(uint32_t binding, size_t index)
{
    return {binding, Binding::What::kBuffer, index};
}
inline Binding bindImage(uint32_t binding, size_t index)
{
    return {binding, Binding::What::kImage, index};
}

// A job of one program, dispatched once, whose buffer 0 comes back.
inline Job makeJob(const std::string& entry, const std::string& glsl, size_t scalarCount, uint32_t groupsX,
                   uint32_t groupsY = 1)
{
    Job job;
    job.label = entry;
    job.programs = {makeProgram(entry, glsl)};
    job.buffers = {makeStorage(scalarCount)};
    job.dispatches = {{0, {bindBuffer(0, 0)}, groupsX, groupsY, 1}};
    job.readbacks = {0};
    return job;
}

struct Driver {
    const char* backend;
    const char* icdFile;
};
inline constexpr Driver kLavapipe{"lavapipe", "/usr/share/vulkan/icd.d/lvp_icd.x86_64.json"};
inline constexpr Driver kSwiftshader{"swiftshader", "/usr/lib/chromium/vk_swiftshader_icd.json"};

// The environment must be set before the loader is asked for the first time.
inline void chooseDriver(const Driver& driver)
{
    setenv("VK_ICD_FILENAMES", driver.icdFile, 1);
    setenv("VK_LOADER_DRIVERS_SELECT", "*", 1);
    setenv("LP_NUM_THREADS", "1", 1);
}

inline std::string nameOfDriver(const testing::TestParamInfo<Driver>& info)
{
    return info.param.backend;
}

// Runs each test on lavapipe, and on SwiftShader where it is installed.
class VulkanTest : public testing::TestWithParam<Driver> {
  protected:
    void SetUp() override
    {
        if (!std::filesystem::exists(GetParam().icdFile)) GTEST_SKIP() << GetParam().icdFile << " is not installed";
        chooseDriver(GetParam());
    }
    std::unique_ptr<Device> open(bool validation = true, const VulkanTuning& tuning = {}) const
    {
        DeviceOptions options;
        options.validation = validation;
        return makeVulkanDevice(GetParam().backend, options, tuning);
    }
};

// What validation says, as one text; "" is what a test wants.
inline std::string joinMessages(const JobResult& result)
{
    std::string text;
    for (const std::string& message : result.messages)
        text += message + "\n";
    return text;
}

inline constexpr const char* kFill = R"(
layout(local_size_x = 64) in;
layout(binding = 0) buffer Out { float values[]; };
void main()
{
    if (gl_GlobalInvocationID.x < values.length())
        values[gl_GlobalInvocationID.x] = float(gl_GlobalInvocationID.x) * 0.5;
}
)";

} // namespace crossray::test
