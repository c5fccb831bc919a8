#include "harness/compile/compile.h"

#include "harness/base/bytes.h"
#include "harness/base/error.h"
#include "harness/compile/cache.h"
#include "harness/compile/confine.h"
#include "harness/compile/cross.h"
#include "harness/compile/frontend.h"
#include "harness/compile/optimize.h"
#include "harness/compile/spirv_module.h"

#include <fmt/format.h>
#include <glslang/Public/ShaderLang.h>
#include <spirv-tools/libspirv.h>
#include <spirv_cross/spirv_cross_c.h>

#include <bit>
#include <chrono>
#include <mutex>
#include <sys/stat.h>

namespace crossray {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

// To be raised with every change of what this module makes of the same source.
constexpr uint64_t kPipelineVersion = 4;

// One file of a closure as it was when the shader was compiled.
struct ClosureFile {
    std::string name;
    fs::path path;
    Hash128 hash;
};

// What tells that a file was not touched since, without reading it.
struct FileStamp {
    int64_t inode = 0, size = 0, modifiedNs = 0;
    bool operator==(const FileStamp&) const = default;
};

std::optional<FileStamp> stampOf(const fs::path& path)
{
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return std::nullopt;
    return FileStamp{static_cast<int64_t>(status.st_ino), status.st_size,
                     status.st_mtim.tv_sec * 1'000'000'000 + status.st_mtim.tv_nsec};
}

// A file written within the clock's tick before it was read could change again under the same stamp.
bool isSettled(const FileStamp& stamp)
{
    const auto now =
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch());
    return now.count() - stamp.modifiedNs > 100'000'000;
}

struct MemoryEntry {
    std::vector<ClosureFile> closure;
    std::vector<FileStamp> stamps; // empty: not to be trusted, the files are to be read again
    CompiledShader shader;
};

void addVersions(Hasher& hasher)
{
    static const std::map<std::string, std::string> versions = ShaderCompiler::versions();
    hasher.addNumber(kPipelineVersion);
    for (const auto& [name, version] : versions)
        hasher.addString(name).addString(version);
}

void addOptions(Hasher& hasher, const CompileOptions& options)
{
    hasher.addNumber(options.optimize ? 1 : 0)
        .addNumber(options.debugInfo ? 1 : 0)
        .addNumber(options.specialization.size());
    for (const auto& [name, value] : options.specialization)
        hasher.addString(name).addNumber(std::bit_cast<uint64_t>(value));
}

// Names the question: which closure did this shader have the last time?
Hash128 hashRequest(const ShaderLocation& shader, const CompileOptions& options)
{
    Hasher hasher;
    addVersions(hasher);
    addOptions(hasher, options);
    hasher.addString("closure").addString(shader.path.string()).addString(fs::absolute(options.includeRoot).string());
    if (!options.ownTracer.empty()) hasher.addString(fs::absolute(options.ownTracer).string());
    return hasher.finish();
}

// Names the answer: equal contents under equal names are the same program, wherever they lie.
Hash128 hashContent(const std::vector<ClosureFile>& closure, const CompileOptions& options)
{
    Hasher hasher;
    addVersions(hasher);
    addOptions(hasher, options);
    hasher.addString("shader");
    for (const ClosureFile& file : closure)
        hasher.addString(file.name).addHash(file.hash);
    return hasher.finish();
}

std::vector<std::byte> encodeClosure(const std::vector<ClosureFile>& closure)
{
    ByteWriter writer;
    writer.put<uint64_t>(closure.size());
    for (const ClosureFile& file : closure) {
        writer.putString(file.name);
        writer.putString(file.path.string());
        writer.put(file.hash.high);
        writer.put(file.hash.low);
    }
    return writer.take();
}

std::vector<ClosureFile> decodeClosure(std::span<const std::byte> bytes)
{
    ByteReader reader(bytes);
    std::vector<ClosureFile> closure(reader.getCount(32));
    for (ClosureFile& file : closure) {
        file.name = reader.getString();
        file.path = reader.getString();
        file.hash.high = reader.get<uint64_t>();
        file.hash.low = reader.get<uint64_t>();
    }
    reader.finish();
    return closure;
}

std::vector<std::byte> encodeShader(const CompiledShader& shader)
{
    ByteWriter writer;
    writer.putVector(shader.spirv);
    writer.putString(shader.glsl);
    for (const uint32_t size : shader.localSize)
        writer.put(size);
    return writer.take();
}

CompiledShader decodeShader(std::span<const std::byte> bytes)
{
    ByteReader reader(bytes);
    CompiledShader shader;
    shader.spirv = reader.getVector<uint32_t>();
    shader.glsl = reader.getString();
    for (uint32_t& size : shader.localSize)
        size = reader.get<uint32_t>();
    reader.finish();
    return shader;
}

bool isUnchanged(const ClosureFile& file)
{
    const std::optional<std::string> text = readFile(file.path, kMaxSourceBytes);
    return text && hashBytes(*text) == file.hash;
}

std::vector<FileStamp> stampAll(const std::vector<ClosureFile>& closure)
{
    std::vector<FileStamp> stamps;
    for (const ClosureFile& file : closure) {
        const std::optional<FileStamp> stamp = stampOf(file.path);
        if (!stamp || !isSettled(*stamp)) return {};
        stamps.push_back(*stamp);
    }
    return stamps;
}

bool stampsHold(const MemoryEntry& entry)
{
    if (entry.stamps.size() != entry.closure.size()) return false;
    for (size_t i = 0; i < entry.closure.size(); ++i) {
        if (stampOf(entry.closure[i].path) != entry.stamps[i]) return false;
    }
    return true;
}

} // namespace

std::optional<CompileTarget> findCompileTarget(std::string_view name)
{
    if (name == "spirv") return CompileTarget::kSpirv;
    if (name == "glsl") return CompileTarget::kGlsl;
    if (name == "essl") return CompileTarget::kEssl;
    if (name == "hlsl") return CompileTarget::kHlsl;
    if (name == "msl") return CompileTarget::kMsl;
    return std::nullopt;
}

struct ShaderCompiler::Impl {
    explicit Impl(fs::path folder) : files(std::move(folder)) {}

    std::optional<CompiledShader> findInMemory(const Hash128& request);
    std::optional<CompiledShader> findOnDisk(const Hash128& request, const CompileOptions& options);
    CompiledShader make(const ShaderLocation& location, const Hash128& request, const CompileOptions& options);
    void remember(const Hash128& request, std::vector<ClosureFile> closure, std::vector<FileStamp> stamps,
                  CompiledShader& shader);

    FileCache files;
    std::mutex mutex;
    std::map<Hash128, MemoryEntry> memory; // by request
};

std::optional<CompiledShader> ShaderCompiler::Impl::findInMemory(const Hash128& request)
{
    MemoryEntry entry;
    {
        const std::lock_guard lock(mutex);
        const auto found = memory.find(request);
        if (found == memory.end()) return std::nullopt;
        entry = found->second;
    }
    if (stampsHold(entry)) return entry.shader;
    std::vector<FileStamp> stamps = stampAll(entry.closure);
    for (const ClosureFile& file : entry.closure) {
        if (!isUnchanged(file)) return std::nullopt;
    }
    remember(request, std::move(entry.closure), std::move(stamps), entry.shader);
    return entry.shader;
}

std::optional<CompiledShader> ShaderCompiler::Impl::findOnDisk(const Hash128& request, const CompileOptions& options)
{
    const std::optional<std::vector<std::byte>> closureBytes = files.find(request);
    if (!closureBytes) return std::nullopt;
    try {
        std::vector<ClosureFile> closure = decodeClosure(*closureBytes);
        std::vector<FileStamp> stamps = stampAll(closure);
        for (const ClosureFile& file : closure) {
            if (!isUnchanged(file)) return std::nullopt;
        }
        const Hash128 key = hashContent(closure, options);
        const std::optional<std::vector<std::byte>> shaderBytes = files.find(key);
        if (!shaderBytes) return std::nullopt;
        CompiledShader shader = decodeShader(*shaderBytes);
        shader.key = key.hex();
        remember(request, std::move(closure), std::move(stamps), shader);
        return shader;
    } catch (const InputError&) { // an entry of another layout
        return std::nullopt;
    }
}

CompiledShader ShaderCompiler::Impl::make(const ShaderLocation& location, const Hash128& request,
                                          const CompileOptions& options)
{
    const bool isOwn = !options.ownTracer.empty();
    const FrontendResult parsed =
        parseShader(location, options.includeRoot, options.debugInfo || isOwn, options.ownTracer);
    CompiledShader shader;
    const std::vector<uint32_t> confined =
        isOwn ? confineOwnTracer(parsed.spirv, displayPath(fs::absolute(options.ownTracer))) : parsed.spirv;
    const std::vector<uint32_t> named = specialize(confined, options.specialization, options.optimize);
    shader.spirv = options.debugInfo ? named : stripDebugInfo(named);
    validate(shader.spirv);
    shader.localSize = findLocalSize(shader.spirv);
    shader.glsl =
        crossCompile(named, CompileTarget::kGlsl, options.debugInfo); // with the names, which a person will read

    std::vector<ClosureFile> closure;
    for (const SourceFile& file : parsed.sources.files())
        closure.push_back({file.name, file.path, file.hash});
    const Hash128 key = hashContent(closure, options);
    shader.key = key.hex();
    files.store(key, encodeShader(shader));
    files.store(request, encodeClosure(closure));
    // No stamps: the files may have changed between their reading and now. The next hit reads them and takes the
    // stamps.
    remember(request, std::move(closure), {}, shader);
    return shader;
}

void ShaderCompiler::Impl::remember(const Hash128& request, std::vector<ClosureFile> closure,
                                    std::vector<FileStamp> stamps, CompiledShader& shader)
{
    shader.closure.clear();
    for (const ClosureFile& file : closure)
        shader.closure.push_back(file.path);
    const std::lock_guard lock(mutex);
    memory[request] = {std::move(closure), std::move(stamps), shader};
}

ShaderCompiler::ShaderCompiler(fs::path cacheFolder) : impl_(std::make_unique<Impl>(std::move(cacheFolder))) {}
ShaderCompiler::~ShaderCompiler() = default;

CompiledShader ShaderCompiler::compile(const fs::path& shader, const CompileOptions& options)
{
    const Clock::time_point start = Clock::now();
    const ShaderLocation location = locateShader(shader, options.includeRoot);
    const Hash128 request = hashRequest(location, options);
    std::optional<CompiledShader> found = impl_->findInMemory(request);
    if (!found) found = impl_->findOnDisk(request, options);
    const bool fromCache = found.has_value();
    CompiledShader result = fromCache ? std::move(*found) : impl_->make(location, request, options);
    result.fromCache = fromCache;
    result.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    return result;
}

std::string ShaderCompiler::translate(const std::vector<uint32_t>& spirv, CompileTarget target)
{
    return crossCompile(spirv, target, false);
}

std::string ShaderCompiler::disassemble(const std::vector<uint32_t>& spirv)
{
    return disassembleSpirv(spirv);
}

size_t ShaderCompiler::countInstructions(const std::vector<uint32_t>& spirv)
{
    return countSpirvInstructions(spirv);
}

std::map<std::string, double> ShaderCompiler::listSpecialization(const fs::path& shader, const CompileOptions& options)
{
    const FrontendResult parsed = parseShader(locateShader(shader, options.includeRoot), options.includeRoot, false);
    std::map<std::string, double> result;
    for (const SpecializationConstant& constant : findSpecializationConstants(parsed.spirv)) {
        result[constant.name] = constant.defaultValue;
    }
    return result;
}

std::map<std::string, std::string> ShaderCompiler::versions()
{
    const glslang::Version frontend = glslang::GetVersion();
    unsigned major = 0, minor = 0, patch = 0;
    spvc_get_version(&major, &minor, &patch);
    return {{"glslang", fmt::format("{}.{}.{}", frontend.major, frontend.minor, frontend.patch)},
            {"SPIRV-Tools", spvSoftwareVersionString()},
            {"SPIRV-Cross", fmt::format("{}.{}.{}", major, minor, patch)}};
}

} // namespace crossray
