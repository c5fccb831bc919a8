// The one interface over Vulkan, OpenGL and the CPU: make a program, upload images and buffers, dispatch, read back, time. It
// has exactly the calls that the passes need. All numbers are scalars of the device's own precision; they cross this interface
// as doubles so that cpu64 loses nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace crossray {

enum class Precision { kFloat, kDouble };

// One compiled compute shader, in every form that some device reads.
struct ProgramSource {
    std::string entry;                          // "entry/screen_trace.comp": the CPU devices look their kernel up by it
    std::map<std::string, double> specialization; // frozen in `spirv` and `glsl`; the CPU devices apply it themselves
    std::vector<uint32_t> spirv;                // 1.3, optimised, validated
    std::string glsl;                           // 4.50 core
    std::string key;                            // content hash: equal keys are equal programs
    std::vector<std::filesystem::path> files{}; // the source and what it includes; devices have no use for them
};

// Linear: between texels and between levels. Nearest: the nearest texel of the nearest level.
enum class ImageFilter { kNearest, kLinear };

// A 2D sampled image of 1 or 4 channels, 32-bit float on float devices, clamp to edge. Level 0 first; level l has size
// max(1, size >> l). A 3-channel plane is uploaded with alpha 1.
struct ImageDesc {
    int width = 0, height = 0, channels = 1, levels = 1;
    ImageFilter filter = ImageFilter::kNearest;
    std::vector<double> texels;
};

enum class BufferKind {
    kUniform, // bytes laid out by std140 (kFloat) or as the double mirror of the same struct (kDouble)
    kStorage, // an array of scalars: float or double
};

struct BufferDesc {
    BufferKind kind = BufferKind::kStorage;
    std::vector<std::byte> bytes; // kUniform: the content
    size_t scalarCount = 0;       // kStorage: the size; filled with zeros
};

// Resources are numbered by their place in the job.
struct Binding {
    uint32_t binding = 0; // layout(binding = N), set 0
    enum class What { kImage, kBuffer } what = What::kBuffer;
    size_t index = 0;
};

// Dispatches run in order; each sees all that the earlier ones wrote.
struct DispatchDesc {
    size_t program = 0;
    std::vector<Binding> bindings;
    uint32_t groupsX = 1, groupsY = 1, groupsZ = 1;
};

// All that one case asks of one device. Self-contained: it crosses the process border to a worker.
struct Job {
    std::string label; // for logs: "case backend"
    std::vector<ProgramSource> programs;
    std::vector<ImageDesc> images;
    std::vector<BufferDesc> buffers;
    std::vector<DispatchDesc> dispatches;
    std::vector<size_t> readbacks; // storage buffers to bring back, in this order
};

struct JobTimes { // milliseconds, wall clock unless said otherwise
    double program = 0;  // shader modules, pipelines, the driver's own compile
    double upload = 0;
    double dispatch = 0; // submit to finish
    double readback = 0;
    double device = -1;  // device timestamps around the dispatches; -1 where the device's clock is not to be trusted
};

struct JobResult {
    std::vector<std::vector<double>> readbacks;
    JobTimes times;
    bool programsWereWarm = true; // every program was already in this worker
    std::vector<std::string> messages; // validation layer and GL debug messages; any message fails the case
};

// What a result depends on beside its inputs.
struct Fingerprint {
    std::string backend;       // "lavapipe"
    std::string api;           // "Vulkan 1.3.230", "OpenGL 4.5 core", "none"
    std::string device;        // "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string driver;        // "Mesa 22.3.6"
    std::string llvm;          // "15.0.6" or ""
    std::string cpu;           // "AuthenticAMD AMD EPYC 7B13"
};

class Device {
  public:
    virtual ~Device() = default;
    virtual Fingerprint fingerprint() const = 0;
    virtual Precision precision() const { return Precision::kFloat; }
    // Runs the job to its end. Programs are kept by key for later jobs (least recently used of 512); everything else is
    // released. Throws ShaderError when the driver refuses a program, EnvironmentError when the device is lost.
    virtual JobResult run(const Job& job) = 0;
};

struct DeviceOptions {
    bool validation = false;        // Vulkan validation layer, GL debug context; missing support is an EnvironmentError
    std::string vulkanDeviceName;   // substring of the device's name; empty: what the backend implies
};

} // namespace crossray
