#include "harness/backend/gl/gl_device.h"

#include "harness/backend/gl/gl_context.h"
#include "harness/backend/gl/gl_debug.h"
#include "harness/backend/gl/gl_fingerprint.h"
#include "harness/backend/gl/gl_limits.h"
#include "harness/backend/gl/gl_program.h"
#include "harness/backend/gl/gl_resources.h"
#include "harness/backend/gl/lru_cache.h"
#include "harness/base/error.h"
#include "harness/base/stopwatch.h"

#include <fmt/format.h>
#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <optional>

namespace crossray {
namespace {

constexpr size_t kProgramsKept = 512;

// All that a job holds on the device, by its place in the job.
struct JobResources {
    std::vector<GlImage> images;
    std::vector<ImageFilter> filters;
    std::vector<GlBuffer> buffers;
    std::vector<GlProgram*> programs;
};

GlSamplerName makeSampler(GLint minify, GLint magnify)
{
    GLuint id = 0;
    glCreateSamplers(1, &id);
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, minify);
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, magnify);
    glSamplerParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return GlSamplerName(id);
}

// A dispatch indirectly by no groups at all: the driver makes machine code for what is bound, and runs nothing.
GlBufferName makeNoGroups()
{
    GLuint id = 0;
    glCreateBuffers(1, &id);
    constexpr std::array<GLuint, 3> kNone{};
    glNamedBufferStorage(id, sizeof(kNone), kNone.data(), 0);
    return GlBufferName(id);
}

const Binding* findBinding(const DispatchDesc& dispatch, uint32_t number)
{
    const auto found = std::find_if(dispatch.bindings.begin(), dispatch.bindings.end(),
                                    [&](const Binding& binding) { return binding.binding == number; });
    return found == dispatch.bindings.end() ? nullptr : &*found;
}

GlResourceKind findKind(const Binding& binding, const JobResources& resources)
{
    if (binding.what == Binding::What::kImage) return GlResourceKind::kSampler;
    return resources.buffers[binding.index].kind == BufferKind::kUniform ? GlResourceKind::kUniformBlock
                                                                         : GlResourceKind::kStorageBlock;
}

void checkIndices(const Job& job)
{
    for (const DispatchDesc& dispatch : job.dispatches) {
        if (dispatch.program >= job.programs.size())
            throw InputError(fmt::format("{}: a dispatch of program {}; the job has {}", job.label, dispatch.program,
                                         job.programs.size()));
        for (const Binding& binding : dispatch.bindings) {
            const bool image = binding.what == Binding::What::kImage;
            const size_t count = image ? job.images.size() : job.buffers.size();
            if (binding.index >= count)
                throw InputError(fmt::format("{}: binding {} is {} {}; the job has {}", job.label, binding.binding,
                                             image ? "image" : "buffer", binding.index, count));
        }
    }
    for (const size_t index : job.readbacks)
        if (index >= job.buffers.size() || job.buffers[index].kind != BufferKind::kStorage)
            throw InputError(
                fmt::format("{}: buffer {} cannot be read back: it is no storage buffer of the job", job.label, index));
}

class GlDevice final : public Device {
  public:
    GlDevice(const std::string& backend, std::unique_ptr<GlContext> context, bool validation)
        : context_(std::move(context)), fingerprint_(readGlFingerprint(backend)), limits_(readGlLimits()),
          pool_(limits_), nearest_(makeSampler(GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST)),
          linear_(makeSampler(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR)), noGroups_(makeNoGroups())
    {
        if (validation) debug_.emplace();
        glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, noGroups_.id());
    }

    ~GlDevice() override
    {
        try {
            context_->makeCurrent(); // the members that die now delete names of this context
        } catch (const EnvironmentError&) {
            // The context is lost, and its names with it.
        }
    }

    GlDevice(const GlDevice&) = delete;
    GlDevice& operator=(const GlDevice&) = delete;

    Fingerprint fingerprint() const override { return fingerprint_; }

    JobResult run(const Job& job) override
    {
        checkIndices(job);
        context_->makeCurrent();
        forgetErrors();
        programs_.trim(kProgramsKept); // here and not at the end, so that jobs which fail cannot pile programs up
        JobResult result;
        JobResources resources;
        // GL's timer queries are wrong by orders of magnitude on software rasterisers: the wall clock around glFinish.
        Stopwatch stopwatch;

        makePrograms(job, resources, result);
        result.times.program = stopwatch.lap();

        for (const ImageDesc& image : job.images) {
            resources.images.push_back(pool_.takeImage(image));
            resources.filters.push_back(image.filter);
        }
        for (const BufferDesc& buffer : job.buffers)
            resources.buffers.push_back(pool_.takeBuffer(buffer));
        glFinish();
        result.times.upload = stopwatch.lap();

        prepareDispatches(job, resources);
        result.times.program += stopwatch.lap();

        for (size_t index = 0; index < job.dispatches.size(); ++index) {
            const DispatchDesc& dispatch = job.dispatches[index];
            bind(job, index, resources);
            glDispatchCompute(dispatch.groupsX, dispatch.groupsY, dispatch.groupsZ);
            glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
        }
        glFinish();
        result.times.dispatch = stopwatch.lap();

        for (const size_t index : job.readbacks)
            result.readbacks.push_back(pool_.read(resources.buffers[index]));
        result.times.readback = stopwatch.lap();

        result.messages = collectMessages();
        release(std::move(resources));
        return result;
    }

  private:
    void makePrograms(const Job& job, JobResources& resources, JobResult& result)
    {
        for (const ProgramSource& source : job.programs) {
            const std::string& key = source.key.empty() ? source.glsl : source.key;
            GlProgram* program = programs_.find(key);
            if (!program) {
                program = &programs_.insert(key, compileGlProgram(source, limits_));
                result.programsWereWarm = false;
            }
            resources.programs.push_back(program);
        }
    }

    // Checks every dispatch, and has the driver make the machine code of new programs, so that the time of that is told
    // apart from the time of running.
    void prepareDispatches(const Job& job, const JobResources& resources)
    {
        bool prepared = false;
        for (size_t index = 0; index < job.dispatches.size(); ++index) {
            checkDispatch(job, index, resources);
            GlProgram& program = *resources.programs[job.dispatches[index].program];
            if (program.hasRun) continue;
            bind(job, index, resources);
            glDispatchComputeIndirect(0);
            program.hasRun = true;
            prepared = true;
        }
        if (prepared) glFinish();
    }

    void checkDispatch(const Job& job, size_t index, const JobResources& resources) const
    {
        const DispatchDesc& dispatch = job.dispatches[index];
        const std::string& entry = job.programs[dispatch.program].entry;
        const auto& most = limits_.groupCount;
        if (dispatch.groupsX > most[0] || dispatch.groupsY > most[1] || dispatch.groupsZ > most[2])
            throw ShaderError(fmt::format("{}: dispatch {} of {}x{}x{} groups; this driver allows {}x{}x{}", entry,
                                          index, dispatch.groupsX, dispatch.groupsY, dispatch.groupsZ, most[0], most[1],
                                          most[2]));
        for (const GlResource& resource : resources.programs[dispatch.program]->resources) {
            const auto fail = [&](const std::string& what) {
                return ShaderError(fmt::format("{}: dispatch {}: the {} {} at binding {} {}", entry, index,
                                               nameGlResourceKind(resource.kind), resource.name, resource.binding,
                                               what));
            };
            const Binding* binding = findBinding(dispatch, resource.binding);
            if (!binding) throw fail("is not bound");
            const GlResourceKind kind = findKind(*binding, resources);
            if (kind != resource.kind) throw fail(fmt::format("is bound to a {}", nameGlResourceKind(kind)));
            if (kind == GlResourceKind::kSampler) continue;
            const size_t bytes = roundUpToVec4(resources.buffers[binding->index].bytes); // as the driver counts
            if (bytes < static_cast<size_t>(resource.bytes))
                throw fail(fmt::format("needs {} bytes, and is bound to a buffer of {}", resource.bytes, bytes));
        }
    }

    void bind(const Job& job, size_t index, const JobResources& resources) const
    {
        const DispatchDesc& dispatch = job.dispatches[index];
        const GlProgram& program = *resources.programs[dispatch.program];
        glUseProgram(program.name.id());
        for (const GlResource& resource : program.resources) {
            const size_t place = findBinding(dispatch, resource.binding)->index;
            if (resource.kind == GlResourceKind::kSampler) {
                glBindTextureUnit(resource.binding, resources.images[place].name.id());
                glBindSampler(resource.binding,
                              (resources.filters[place] == ImageFilter::kLinear ? linear_ : nearest_).id());
            } else {
                const GlBuffer& buffer = resources.buffers[place];
                glBindBufferRange(resource.kind == GlResourceKind::kUniformBlock ? GL_UNIFORM_BUFFER
                                                                                 : GL_SHADER_STORAGE_BUFFER,
                                  resource.binding, buffer.name.id(), 0, static_cast<GLsizeiptr>(buffer.bytes));
            }
        }
    }

    // What an earlier job left behind when it ended in an exception is not this one's.
    void forgetErrors()
    {
        while (glGetError() != GL_NO_ERROR) {
        }
        if (debug_) debug_->take();
    }

    std::vector<std::string> collectMessages()
    {
        std::vector<std::string> messages;
        if (debug_) messages = debug_->take();
        for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) {
            if (error == GL_OUT_OF_MEMORY || error == GL_CONTEXT_LOST)
                throw EnvironmentError(
                    fmt::format("{}: OpenGL {}", fingerprint_.backend,
                                error == GL_OUT_OF_MEMORY ? "is out of memory" : "lost its context"));
            messages.push_back(fmt::format("OpenGL error 0x{:04x}", error));
        }
        return messages;
    }

    void release(JobResources resources)
    {
        for (GlImage& image : resources.images)
            pool_.giveBack(std::move(image));
        for (GlBuffer& buffer : resources.buffers)
            pool_.giveBack(std::move(buffer));
        glUseProgram(0); // a dropped program that is in use would live on
    }

    std::unique_ptr<GlContext> context_; // first in, last out
    Fingerprint fingerprint_;
    GlLimits limits_;
    GlResourcePool pool_;
    LruCache<GlProgram> programs_;
    GlSamplerName nearest_;
    GlSamplerName linear_;
    GlBufferName noGroups_;
    std::optional<GlDebugLog> debug_;
};

std::unique_ptr<GlContext> makeContext(const std::string& backend, bool debug)
{
    if (backend == "egl") return makeEglContext(debug);
    return makeOsmesaContext();
}

// A result under the name of another driver would be worse than none.
void checkDriver(const std::string& backend)
{
    const std::string renderer = readGlFingerprint(backend).device;
    const std::string promised = backend == "osmesa" ? "llvmpipe" : backend == "softpipe" ? "softpipe" : "";
    if (renderer.find(promised) == std::string::npos)
        throw EnvironmentError(
            fmt::format("{} promises the driver {}, and OpenGL runs on \"{}\": set GALLIUM_DRIVER={} "
                        "before the process starts",
                        backend, promised, renderer, promised));
}

} // namespace

std::unique_ptr<Device> makeGlDevice(const std::string& backendName, const DeviceOptions& options)
{
    if (backendName != "osmesa" && backendName != "softpipe" && backendName != "egl")
        throw EnvironmentError(fmt::format("\"{}\" is no OpenGL backend: osmesa, softpipe and egl are", backendName));
    static std::string opened; // the one backend of this process
    if (!opened.empty() && opened != backendName)
        throw EnvironmentError(fmt::format("{} cannot be opened in a process that has opened {}", backendName, opened));

    std::unique_ptr<GlContext> context = makeContext(backendName, options.validation);
    context->makeCurrent();
    const auto load = [](void* self, const char* name) { return static_cast<GlContext*>(self)->findProcedure(name); };
    const int version = gladLoadGLUserPtr(load, context.get());
    if (version < GLAD_MAKE_VERSION(4, 5))
        throw EnvironmentError(fmt::format("{} gives OpenGL {}.{}; 4.5 is needed", backendName,
                                           GLAD_VERSION_MAJOR(version), GLAD_VERSION_MINOR(version)));
    checkDriver(backendName);
    opened = backendName;
    return std::make_unique<GlDevice>(backendName, std::move(context), options.validation);
}

} // namespace crossray
