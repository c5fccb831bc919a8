// A shared library that is opened while the program runs, so that the program starts without it.
#pragma once

#include <initializer_list>
#include <string>

namespace crossray {

class DynamicLibrary {
  public:
    // Opens the first of `names` that is found. Throws EnvironmentError "... is missing: install PACKAGE".
    DynamicLibrary(std::initializer_list<const char*> names, const std::string& package);

    // Throws EnvironmentError when the library lacks the symbol. Function is a pointer-to-function type.
    template <typename Function>
    Function find(const char* symbol) const
    {
        return reinterpret_cast<Function>(findAddress(symbol));
    }

  private:
    void* findAddress(const char* symbol) const;

    // Never closed: Mesa keeps threads and exit handlers that outlive every context.
    void* handle_ = nullptr;
    std::string name_;
};

} // namespace crossray
