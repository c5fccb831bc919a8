// The shader pipeline: one GLSL source -> SPIR-V 1.3 (glslang) -> optimised and validated (SPIRV-Tools) -> GLSL 4.50
// and other languages (SPIRV-Cross). Variants come from specialization constants, which are frozen before the optimiser
// runs, so that what a variant does not use is not in its code.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

enum class CompileTarget { kSpirv, kGlsl, kEssl, kHlsl, kMsl };
std::optional<CompileTarget> findCompileTarget(std::string_view name);

struct CompileOptions {
    std::filesystem::path includeRoot;            // includes are rooted here: the folder shaders/
    std::map<std::string, double> specialization; // by the constant's name in the source; unknown names are an error
    bool optimize = true;
    bool debugInfo = false; // keep names and lines
    // A person's file that stands in for the include of entry/own_trace.comp; confine.h has what it may do. Empty:
    // none.
    std::filesystem::path ownTracer{};
};

struct CompiledShader {
    std::vector<uint32_t> spirv;
    std::string glsl; // 4.50 core, with the source's names; with #line directives under debugInfo
    std::string key;  // content hash of source closure, options and compiler versions
    std::array<uint32_t, 3> localSize{1, 1, 1};
    bool fromCache = false;
    double milliseconds = 0;
    std::vector<std::filesystem::path> closure; // the source and every file it includes
};

// Keeps glslang initialised for the life of the process; calls are safe from several threads. The cache folder is
// created when it is missing; an unwritable one is no error, entries that are truncated or of another version are made
// anew.
class ShaderCompiler {
  public:
    explicit ShaderCompiler(std::filesystem::path cacheFolder); // empty: no cache on disk
    virtual ~ShaderCompiler();
    ShaderCompiler(const ShaderCompiler&) = delete;
    ShaderCompiler& operator=(const ShaderCompiler&) = delete;

    // SPIR-V and GLSL 4.50 of a file below the include root ("entry/screen_trace.comp") or anywhere else. Throws
    // ShaderError with "file:line:column: error: text" lines of the source the person wrote.
    virtual CompiledShader compile(const std::filesystem::path& shader, const CompileOptions& options);
    // The text of any target language from SPIR-V; kSpirv gives the disassembly. Names are those of a debugInfo
    // compile.
    std::string translate(const std::vector<uint32_t>& spirv, CompileTarget target);
    // Human-readable SPIR-V, and the number of instructions in it.
    std::string disassemble(const std::vector<uint32_t>& spirv);
    static size_t countInstructions(const std::vector<uint32_t>& spirv);
    // The specialization constants of a source with their defaults.
    std::map<std::string, double> listSpecialization(const std::filesystem::path& shader,
                                                     const CompileOptions& options);

    // {"glslang", "12.0.0"}, {"SPIRV-Tools", "SPIRV-Tools v2023.1 ..."}, {"SPIRV-Cross", "0.54.0"}: part of every
    // fingerprint.
    static std::map<std::string, std::string> versions();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Text of a debugInfo compile with its #line directives as empty lines: drivers refuse #line with a file's name, and
// the line numbers of their messages are then those that mapDriverMessage reads.
std::string blankLineDirectives(const std::string& generatedGlsl);

// Maps a driver's message about generated GLSL ("0:123(45): error: ...") back to the line of the source, by the #line
// directives in the generated text, which are there when it was compiled with debugInfo. Names of files below
// `includeRoot` become paths. Returns the message unchanged when there is nothing to map.
std::string mapDriverMessage(const std::string& message, const std::string& generatedGlsl,
                             const std::filesystem::path& includeRoot = {});

} // namespace crossray
