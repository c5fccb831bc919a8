#include "harness/compile/cross.h"

#include "harness/base/error.h"
#include "harness/compile/optimize.h"

#include <spirv_cross/spirv_cross_c.h>

namespace crossray {

namespace {

class CrossContext {
  public:
    CrossContext()
    {
        if (spvc_context_create(&context_) != SPVC_SUCCESS) throw ShaderError("SPIRV-Cross cannot be started");
    }
    ~CrossContext() { spvc_context_destroy(context_); }
    CrossContext(const CrossContext&) = delete;
    CrossContext& operator=(const CrossContext&) = delete;
    spvc_context get() const { return context_; }
    void require(spvc_result result) const
    {
        if (result == SPVC_SUCCESS) return;
        throw ShaderError(std::string("SPIRV-Cross: ") + spvc_context_get_last_error_string(context_));
    }

  private:
    spvc_context context_ = nullptr;
};

spvc_backend backendOf(CompileTarget target)
{
    switch (target) {
    case CompileTarget::kHlsl:
        return SPVC_BACKEND_HLSL;
    case CompileTarget::kMsl:
        return SPVC_BACKEND_MSL;
    default:
        return SPVC_BACKEND_GLSL;
    }
}

void setOptions(const CrossContext& context, spvc_compiler_options options, CompileTarget target, bool lineDirectives)
{
    const auto setUint = [&](spvc_compiler_option option, unsigned value) {
        context.require(spvc_compiler_options_set_uint(options, option, value));
    };
    const auto setBool = [&](spvc_compiler_option option, bool value) {
        context.require(spvc_compiler_options_set_bool(options, option, value ? SPVC_TRUE : SPVC_FALSE));
    };
    setBool(SPVC_COMPILER_OPTION_EMIT_LINE_DIRECTIVES, lineDirectives);
    switch (target) {
    case CompileTarget::kGlsl:
        setUint(SPVC_COMPILER_OPTION_GLSL_VERSION, 450);
        setBool(SPVC_COMPILER_OPTION_GLSL_ES, false);
        break;
    case CompileTarget::kEssl:
        setUint(SPVC_COMPILER_OPTION_GLSL_VERSION, 310);
        setBool(SPVC_COMPILER_OPTION_GLSL_ES, true);
        break;
    case CompileTarget::kHlsl:
        setUint(SPVC_COMPILER_OPTION_HLSL_SHADER_MODEL, 60);
        break;
    case CompileTarget::kMsl:
        setUint(SPVC_COMPILER_OPTION_MSL_VERSION, SPVC_MAKE_MSL_VERSION(2, 1, 0));
        setBool(SPVC_COMPILER_OPTION_MSL_ENABLE_DECORATION_BINDING, true);
        break;
    case CompileTarget::kSpirv:
        break;
    }
}

} // namespace

std::string crossCompile(const std::vector<uint32_t>& spirv, CompileTarget target, bool lineDirectives)
{
    if (target == CompileTarget::kSpirv) return disassembleSpirv(spirv);
    const CrossContext context;
    spvc_parsed_ir ir = nullptr;
    context.require(spvc_context_parse_spirv(context.get(), spirv.data(), spirv.size(), &ir));
    spvc_compiler compiler = nullptr;
    context.require(spvc_context_create_compiler(context.get(), backendOf(target), ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP,
                                                 &compiler));
    spvc_compiler_options options = nullptr;
    context.require(spvc_compiler_create_compiler_options(compiler, &options));
    setOptions(context, options, target, lineDirectives);
    context.require(spvc_compiler_install_compiler_options(compiler, options));
    const char* text = nullptr;
    context.require(spvc_compiler_compile(compiler, &text));
    return text;
}

} // namespace crossray
