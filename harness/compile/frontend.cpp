#include "harness/compile/frontend.h"

#include "harness/base/error.h"
#include "harness/compile/confine.h"
#include "harness/compile/message.h"

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <cstring>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <pthread.h>
#include <sstream>

namespace crossray {

namespace fs = std::filesystem;

namespace {

// Once a process and never undone: the first set-up of the built-in functions costs a hundred milliseconds.
void initializeGlslang()
{
    static std::once_flag once;
    std::call_once(once, [] { glslang::InitializeProcess(); });
}

EShLanguage findStage(const fs::path& path)
{
    const std::string extension = path.extension().string();
    if (extension == ".comp") return EShLangCompute;
    if (extension == ".vert") return EShLangVertex;
    if (extension == ".frag") return EShLangFragment;
    throw InputError({displayPath(path)},
                     fmt::format("unknown shader stage \"{}\"; allowed are .comp, .vert and .frag", extension));
}

// Finds "crossray/core/maths.glsl" below the root, and nothing outside it.
class RootedIncluder : public glslang::TShader::Includer {
  public:
    RootedIncluder(SourceSet& sources, const fs::path& root, const fs::path& ownTracer)
        : sources_(sources), root_(root), ownTracer_(ownTracer)
    {
    }

    // Called for both forms of the directive, for "..." after includeLocal has declined.
    IncludeResult* includeSystem(const char* headerName, const char*, size_t depth) override
    {
        if (failed_) return fail(kAfterFailure); // else a doubling tree of includes would go on for long
        const std::string name(headerName);
        const fs::path relative = fs::path(name).lexically_normal();
        if (relative.empty() || relative.is_absolute() || *relative.begin() == "..") {
            return fail(fmt::format("includes are rooted at {} and may not leave it", displayPath(root_)));
        }
        if (depth > kMaxIncludeDepth) return fail(fmt::format("includes nest deeper than {}", kMaxIncludeDepth));
        try {
            const bool isOwn = relative == kOwnTracerInclude && !ownTracer_.empty();
            const SourceFile& file =
                sources_.open(relative.generic_string(), isOwn ? fs::absolute(ownTracer_) : root_ / relative);
            bytes_ += file.text.size() + 1;
            if (bytes_ > kMaxClosureBytes) {
                return fail(fmt::format("all inclusions together may have at most {} bytes", kMaxClosureBytes));
            }
            return keep(file.name, file.text);
        } catch (const InputError& error) {
            return fail(error.what());
        }
    }
    void releaseInclude(IncludeResult*) override {} // kept with the includer

  private:
    IncludeResult* keep(const std::string& name, const std::string& text)
    {
        results_.push_back(std::make_unique<IncludeResult>(name, text.data(), text.size(), nullptr));
        return results_.back().get();
    }
    IncludeResult* fail(std::string text)
    {
        failed_ = true;
        texts_.push_back(std::make_unique<std::string>(std::move(text)));
        return keep("", *texts_.back());
    }

    SourceSet& sources_;
    fs::path root_;
    fs::path ownTracer_;
    size_t bytes_ = 0;
    bool failed_ = false;
    std::vector<std::unique_ptr<IncludeResult>> results_;
    std::vector<std::unique_ptr<std::string>> texts_;
};

// Directives of that kind would make a line of the person's file pass for another file's.
void refuseLineDirectives(const SourceFile& file)
{
    int number = 0;
    std::istringstream lines(file.text);
    for (std::string line; std::getline(lines, line);) {
        ++number;
        const size_t mark = line.find_first_not_of(" \t");
        if (mark == std::string::npos || line[mark] != '#') continue;
        const size_t word = line.find_first_not_of(" \t", mark + 1);
        if (word == std::string::npos || line.compare(word, 4, "line") != 0) continue;
        throw ShaderError(SourcePosition{displayPath(file.path), number, static_cast<int>(mark) + 1}.format() +
                          ": error: #line is not allowed in a tracer");
    }
}

// What is wrong with a program of which a person's tracer is a part: in their file, or else because of it.
std::string explainOwnTracer(const std::string& log, const std::string& rewritten, const fs::path& ownTracer)
{
    const std::string file = displayPath(fs::absolute(ownTracer));
    if (log.find("No function definition (body) found") != std::string::npos &&
        log.find("traceOwn(") != std::string::npos) {
        return fmt::format("{}: error: it does not define {}", file, kOwnTracerFunction);
    }
    if (rewritten.find(file) != std::string::npos) return rewritten;
    return fmt::format("{}: error: the harness's own code does not compile with it: {}", file,
                       rewritten.substr(0, rewritten.find('\n')));
}

FrontendResult parseHere(const ShaderLocation& location, const fs::path& includeRoot, bool lines,
                         const fs::path& ownTracer, SourceSet known)
{
    const EShLanguage stage = findStage(location.path);
    FrontendResult result;
    result.sources = std::move(known);
    const SourceFile& entry = result.sources.open(location.name, location.path);
    RootedIncluder includer(result.sources, includeRoot, ownTracer);
    const auto explain = [&](const std::string& log) {
        const std::string rewritten = rewriteMessages(log, result.sources, entry);
        return ownTracer.empty() ? rewritten : explainOwnTracer(log, rewritten, ownTracer);
    };
    initializeGlslang();

    constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules | EShMsgEnhanced);
    glslang::TShader shader(stage);
    const char* text = entry.text.c_str();
    const int length = static_cast<int>(entry.text.size());
    const char* name = entry.name.c_str();
    shader.setStringsWithLengthsAndNames(&text, &length, &name, 1);
    shader.setPreamble("#extension GL_GOOGLE_include_directive : require\n");
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    shader.setEnhancedMsgs();
    if (!shader.parse(GetDefaultResources(), 450, ECoreProfile, false, false, kMessages, includer)) {
        throw ShaderError(explain(shader.getInfoLog()));
    }
    if (const SourceFile* own = result.sources.find(kOwnTracerInclude)) refuseLineDirectives(*own);
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(kMessages)) throw ShaderError(explain(program.getInfoLog()));

    glslang::SpvOptions options;
    options.generateDebugInfo = lines;
    options.disableOptimizer = true;
    spv::SpvBuildLogger logger;
    glslang::GlslangToSpv(*program.getIntermediate(stage), result.spirv, &logger, &options);
    if (result.spirv.empty()) throw ShaderError(rewriteMessages(logger.getAllMessages(), result.sources, entry));
    return result;
}

// Calls work() on a thread of its own with a stack for the deepest expression that a source may have: glslang recurses
// over it.
void runWithLargeStack(const std::function<void()>& work)
{
    constexpr size_t kStackBytes = 128 << 20; // reserved, and only used as far as it is touched
    struct Call {
        const std::function<void()>& work;
        std::exception_ptr failure;
    } call{work, nullptr};
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, kStackBytes);
    pthread_t thread{};
    const auto body = [](void* argument) -> void* {
        auto& mine = *static_cast<Call*>(argument);
        try {
            mine.work();
        } catch (...) {
            mine.failure = std::current_exception();
        }
        return nullptr;
    };
    const int failed = pthread_create(&thread, &attributes, body, &call);
    pthread_attr_destroy(&attributes);
    if (failed != 0) throw EnvironmentError(fmt::format("cannot start a compiler thread: {}", std::strerror(failed)));
    pthread_join(thread, nullptr);
    if (call.failure) std::rethrow_exception(call.failure);
}

} // namespace

FrontendResult parseShader(const ShaderLocation& location, const fs::path& includeRoot, bool lines,
                           const fs::path& ownTracer, SourceSet known)
{
    FrontendResult result;
    runWithLargeStack([&] { result = parseHere(location, includeRoot, lines, ownTracer, std::move(known)); });
    return result;
}

} // namespace crossray
