#include "harness/run/worker_backends.h"

#include "harness/backend/cpu/cpu_device.h"
#include "harness/backend/gl/gl_device.h"
#include "harness/backend/vulkan/vulkan_device.h"
#include "harness/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <optional>

namespace crossray {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> splitPaths(const char* variable)
{
    std::vector<fs::path> paths;
    const char* value = std::getenv(variable);
    std::string_view rest = value != nullptr ? value : "";
    while (!rest.empty()) {
        const std::string_view path = rest.substr(0, rest.find(':'));
        if (!path.empty()) paths.emplace_back(path);
        rest.remove_prefix(std::min(rest.size(), path.size() + 1));
    }
    return paths;
}

std::optional<fs::path> findFile(std::initializer_list<fs::path> folders, const std::string& prefix,
                                 const std::string& suffix)
{
    for (const fs::path& folder : folders) {
        std::error_code failed;
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(folder, failed)) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with(prefix) && name.ends_with(suffix)) found.push_back(entry.path());
        }
        if (!found.empty()) return *std::min_element(found.begin(), found.end());
    }
    return std::nullopt;
}

std::optional<fs::path> findLavapipe()
{
    return findFile({"/usr/share/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/etc/vulkan/icd.d"}, "lvp_icd",
                    ".json");
}

std::optional<fs::path> findSwiftShader()
{
    return findFile({"/usr/lib/chromium", "/usr/lib/chromium-browser", "/opt/google/chrome", "/usr/share/vulkan/icd.d",
                     "/usr/local/share/vulkan/icd.d", "/usr/lib/swiftshader"},
                    "vk_swiftshader_icd", ".json");
}

bool hasLibrary(const std::string& name)
{
    std::vector<fs::path> folders = splitPaths("LD_LIBRARY_PATH");
    for (const char* folder :
         {"/usr/lib/x86_64-linux-gnu", "/usr/lib/aarch64-linux-gnu", "/usr/lib64", "/usr/lib", "/usr/local/lib"}) {
        folders.emplace_back(folder);
    }
    std::error_code ignored;
    return std::any_of(folders.begin(), folders.end(),
                       [&](const fs::path& folder) { return fs::exists(folder / name, ignored); });
}

bool hasOsmesa()
{
    return hasLibrary("libOSMesa.so.8") || hasLibrary("libOSMesa.so.6") || hasLibrary("libOSMesa.so");
}

bool isGl(const std::string& backend)
{
    return backend == "osmesa" || backend == "softpipe" || backend == "egl";
}

bool isVulkan(const std::string& backend)
{
    return backend == "lavapipe" || backend == "swiftshader" || backend.starts_with("vulkan:");
}

} // namespace

std::vector<BackendInfo> listBackends()
{
    const bool osmesa = hasOsmesa();
    const bool egl = (hasLibrary("libEGL.so.1") || hasLibrary("libEGL.so")) && hasLibrary("libEGL_mesa.so.0");
    std::vector<BackendInfo> backends{
        {"lavapipe", "Vulkan", true, findLavapipe().has_value(), "mesa-vulkan-drivers"},
        {"swiftshader", "Vulkan", true, findSwiftShader().has_value(), "chromium-common"},
        {"osmesa", "OpenGL", true, osmesa, "libosmesa6"},
        {"softpipe", "OpenGL", true, osmesa, "libosmesa6"},
        {"egl", "OpenGL", false, egl, "libegl1 libegl-mesa0"},
        {"cpu32", "none", true, true, ""},
        {"cpu64", "none", true, true, ""},
    };
    for (BackendInfo& backend : backends) {
        if (backend.found) backend.missing.clear();
    }
    return backends;
}

std::map<std::string, std::string> workerEnvironment(const std::string& backend, const WorkerOptions& options)
{
    std::map<std::string, std::string> variables{
        // Bilinear filtering of 8-bit images in full precision instead of the fast path's 8 bits.
        {"GALLIVM_PERF", "no_aos_sampling"},
        // A worker has one core: Mesa's own threads would only be switched to and fro.
        {"LP_NUM_THREADS", "0"},
        {"NODEVICE_SELECT", "1"}, // Mesa's device-sorting layer looks for displays
        {"DISPLAY", ""},
        {"WAYLAND_DISPLAY", ""},
        {"GALLIUM_DRIVER", ""},
        {"MESA_GL_VERSION_OVERRIDE", ""},
        {"MESA_GLSL_VERSION_OVERRIDE", ""},
    };
    const bool cached = !options.mesaCacheFolder.empty();
    variables.emplace("MESA_SHADER_CACHE_DISABLE", cached ? "" : "true");
    if (cached) variables.emplace("MESA_SHADER_CACHE_DIR", fs::absolute(options.mesaCacheFolder).string());
    const std::optional<fs::path> icd = backend == "lavapipe"      ? findLavapipe()
                                        : backend == "swiftshader" ? findSwiftShader()
                                                                   : std::nullopt;
    if (icd) {
        variables["VK_ICD_FILENAMES"] = icd->string();
        variables["VK_DRIVER_FILES"] = icd->string();
    }
    if (isGl(backend))
        variables.insert_or_assign("GALLIUM_DRIVER", std::string(backend == "softpipe" ? "softpipe" : "llvmpipe"));
    if (backend == "softpipe") {
        variables.insert_or_assign("MESA_GL_VERSION_OVERRIDE", std::string("4.5"));
        variables.insert_or_assign("MESA_GLSL_VERSION_OVERRIDE", std::string("450"));
    }
    if (backend == "egl") {
        variables.insert_or_assign("EGL_PLATFORM", std::string("surfaceless"));
        variables.insert_or_assign("LIBGL_ALWAYS_SOFTWARE", std::string("1"));
    }
    return variables;
}

std::unique_ptr<Device> openDevice(const std::string& backend, const DeviceOptions& options)
{
    if (isVulkan(backend)) return makeVulkanDevice(backend, options);
    if (isGl(backend)) return makeGlDevice(backend, options);
    if (backend == "cpu32") return makeCpuDevice(Precision::kFloat);
    if (backend == "cpu64") return makeCpuDevice(Precision::kDouble);
    std::vector<std::string> known;
    for (const BackendInfo& info : listBackends())
        known.push_back(info.name);
    throw InputError(
        fmt::format("unknown backend \"{}\"; allowed are {}, vulkan:NAME", backend, fmt::join(known, ", ")));
}

} // namespace crossray
