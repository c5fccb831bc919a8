#include "harness/run/worker_explain.h"

#include "harness/base/error.h"
#include "harness/run/job_codec.h"

#include <optional>

namespace crossray {

namespace {

// The text of the program with its lines, or nothing when its source is not at hand.
std::optional<std::string> compileWithLines(const ProgramSource& program, ShaderCompiler& compiler,
                                            const std::filesystem::path& shaderRoot)
{
    CompileOptions options;
    options.includeRoot = shaderRoot;
    options.specialization = program.specialization;
    options.debugInfo = true;
    try {
        return compiler.compile(program.entry, options).glsl;
    } catch (const Error&) {
        return std::nullopt;
    }
}

} // namespace

JobReport runExplained(WorkerPool& pool, ShaderCompiler& compiler, const std::filesystem::path& shaderRoot,
                       const std::string& backend, int core, const Job& job, std::chrono::duration<double> timeout)
{
    JobReport report = pool.run(backend, core, job, timeout);
    if (report.outcome != JobOutcome::kShaderError || programFormOf(backend) != ProgramForm::kGlsl) return report;
    for (const ProgramSource& program : job.programs) {
        const std::optional<std::string> text = compileWithLines(program, compiler, shaderRoot);
        if (!text) continue;
        Job probe;
        probe.label = job.label;
        probe.programs = {program};
        probe.programs[0].glsl = blankLineDirectives(*text);
        probe.programs[0].key += " with lines";
        const JobReport again = pool.run(backend, core, probe, timeout);
        if (again.outcome != JobOutcome::kShaderError) continue;
        report.text = mapDriverMessage(again.text, *text, shaderRoot);
        break;
    }
    return report;
}

} // namespace crossray
