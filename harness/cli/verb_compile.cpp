#include "harness/cli/verbs.h"
#include "harness/compile/compile.h"
#include "harness/run/environment.h"
#include "harness/run/plane_files.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace crossray {

namespace {

namespace fs = std::filesystem;

std::map<std::string, double> parseSpecialization(const std::vector<std::string>& settings)
{
    std::map<std::string, double> values;
    for (const std::string& setting : settings) {
        const size_t equals = setting.find('=');
        double value = 0;
        bool valid = equals != std::string::npos && equals > 0;
        if (valid) {
            const char* const end = setting.data() + setting.size();
            const auto [rest, failure] = std::from_chars(setting.data() + equals + 1, end, value);
            valid = failure == std::errc{} && rest == end && std::isfinite(value);
        }
        if (!valid) throw InputError(fmt::format("--spec {}: allowed is NAME=NUMBER", setting));
        values[setting.substr(0, equals)] = value;
    }
    return values;
}

// A path as it stands, or below the shader folder.
fs::path findShader(const std::string& name, const fs::path& shaderRoot)
{
    std::error_code failure;
    for (const fs::path& candidate : {fs::path(name), shaderRoot / name, shaderRoot / "entry" / name}) {
        if (fs::is_regular_file(candidate, failure)) return candidate;
    }
    throw InputError({name, 0, 0},
                     fmt::format("there is no such shader, neither here nor below {}", shaderRoot.string()));
}

} // namespace

int compileShader(const GlobalOptions& global, const CompileVerbOptions& options)
{
    const auto target = findCompileTarget(options.target);
    if (!target) {
        throw InputError(fmt::format(
            "--target {}: there is no such language; allowed are spirv, glsl, essl, hlsl and msl", options.target));
    }
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    ShaderCompiler compiler(folders.cache / "spirv");
    CompileOptions compileOptions;
    compileOptions.includeRoot = folders.shaders;
    compileOptions.specialization = parseSpecialization(options.specialization);
    compileOptions.optimize = options.optimize;
    // Other languages take their names from it.
    compileOptions.debugInfo = *target != CompileTarget::kSpirv && *target != CompileTarget::kGlsl;
    const CompiledShader shader = compiler.compile(findShader(options.shader, folders.shaders), compileOptions);

    std::string content;
    if (*target == CompileTarget::kSpirv && (options.assembly || options.output.empty())) {
        content = compiler.disassemble(shader.spirv); // words are for files, not for terminals
    } else if (*target == CompileTarget::kSpirv) {
        content.assign(reinterpret_cast<const char*>(shader.spirv.data()), shader.spirv.size() * sizeof(uint32_t));
    } else if (*target == CompileTarget::kGlsl && !shader.glsl.empty()) {
        content = shader.glsl;
    } else {
        content = compiler.translate(shader.spirv, *target);
    }
    if (options.output.empty()) {
        fmt::print("{}", content);
    } else {
        writeFileWhole(options.output, content);
    }
    return static_cast<int>(ExitCode::kAsExpected);
}

} // namespace crossray
