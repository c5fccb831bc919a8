// The device that the tests of this folder run on: CROSSRAY_GL_BACKEND names it ("osmesa" where it is not set), so that
// the same tests run once a backend, each in a process of its own.
#pragma once

#include "harness/backend/gl/gl_device.h"
#include "harness/base/error.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

namespace crossray {

// The name of the backend under test. The first call sets the environment, which Mesa reads when a context is made.
inline const std::string& testBackend()
{
    static const std::string name = [] {
        const char* asked = std::getenv("CROSSRAY_GL_BACKEND");
        const std::string backend = asked ? asked : "osmesa";
        setenv("MESA_SHADER_CACHE_DIR", CROSSRAY_BINARY_DIR "/mesa-cache", 1);
        setenv("GALLIVM_PERF", "no_aos_sampling", 1);
        setenv("LP_NUM_THREADS", "0", 1);
        if (backend == "softpipe") {
            setenv("GALLIUM_DRIVER", "softpipe", 1);
            setenv("MESA_GL_VERSION_OVERRIDE", "4.5", 1);
            setenv("MESA_GLSL_VERSION_OVERRIDE", "450", 1);
        } else {
            unsetenv("GALLIUM_DRIVER");
        }
        return backend;
    }();
    return name;
}

// A test has a device of its own, with GL's debug output on. egl alone may be missing.
class GlTest : public ::testing::Test {
  protected:
    void SetUp() override
    {
        DeviceOptions options;
        options.validation = true;
        try {
            device_ = makeGlDevice(testBackend(), options);
        } catch (const EnvironmentError& error) {
            if (testBackend() == "egl") GTEST_SKIP() << error.what();
            throw;
        }
    }

    // A job that leaves a debug message fails.
    JobResult run(const Job& job)
    {
        JobResult result = device_->run(job);
        for (const std::string& message : result.messages)
            ADD_FAILURE() << message;
        return result;
    }

    bool isRenderer(const std::string& part) const
    {
        return device_->fingerprint().device.find(part) != std::string::npos;
    }

    std::unique_ptr<Device> device_;
};

// A compute shader in GLSL 4.50. It writes to `result`, the storage buffer at binding 0.
inline std::string makeGlsl(const std::string& body, const std::string& declarations = "", int localX = 1,
                            int localY = 1)
{
    return fmt::format(
        "#version 450\nlayout(local_size_x = {}, local_size_y = {}, local_size_z = 1) in;\n"
        "layout(binding = 0, std430) buffer Result {{ float result[]; }};\n{}\nvoid main()\n{{\n{}\n}}\n",
        localX, localY, declarations, body);
}

inline ProgramSource makeProgram(const std::string& glsl)
{
    ProgramSource source;
    source.entry = "entry/test.comp";
    source.glsl = glsl;
    source.key = std::to_string(std::hash<std::string>{}(glsl));
    return source;
}

inline BufferDesc makeStorage(size_t scalarCount)
{
    BufferDesc desc;
    desc.scalarCount = scalarCount;
    return desc;
}

inline Binding bindBuffer(uint32_t number, size_t index)
{
    return {number, Binding::What::kBuffer, index};
}
inline Binding bindImage(uint32_t number, size_t index)
{
    return {number, Binding::What::kImage, index};
}

// One program, one group; `scalarCount` floats at binding 0 come back.
inline Job makeJob(const std::string& glsl, size_t scalarCount)
{
    Job job;
    job.label = "test";
    job.programs.push_back(makeProgram(glsl));
    job.buffers.push_back(makeStorage(scalarCount));
    DispatchDesc dispatch;
    dispatch.bindings.push_back(bindBuffer(0, 0));
    job.dispatches.push_back(dispatch);
    job.readbacks.push_back(0);
    return job;
}

// The text of the error of type E that `action` throws; empty, with a failure, when it throws none.
template <typename E, typename Action>
std::string catchError(Action action)
{
    try {
        action();
    } catch (const E& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

} // namespace crossray
