#include "harness/backend/gl/dynamic_library.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <dlfcn.h>

namespace crossray {

DynamicLibrary::DynamicLibrary(std::initializer_list<const char*> names, const std::string& package)
{
    std::string reason;
    for (const char* name : names) {
        handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
        if (handle_) {
            name_ = name;
            return;
        }
        if (reason.empty()) reason = dlerror();
    }
    throw EnvironmentError(
        fmt::format("{} cannot be loaded ({}): install the package {}", *names.begin(), reason, package));
}

void* DynamicLibrary::findAddress(const char* symbol) const
{
    if (void* address = dlsym(handle_, symbol)) return address;
    throw EnvironmentError(fmt::format("{} has no function {}: a newer version is needed", name_, symbol));
}

} // namespace crossray
