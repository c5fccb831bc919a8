#include "harness/backend/cpu/cpu_device.h"

#include "harness/backend/cpu/kernels.h"
#include "harness/base/cpu_info.h"
#include "harness/base/error.h"
#include "harness/base/stopwatch.h"

#include <fmt/format.h>


namespace crossray {

namespace {

// The two precisions behind one set of names.
template <class Real>
struct KernelLibrary;
template <>
struct KernelLibrary<float> {
    static auto kernels() { return cpu32::kernels(); }
    static bool setVariant(std::string_view name, double value) { return cpu32::setVariant(name, value); }
    static void resetVariants() { cpu32::resetVariants(); }
};
template <>
struct KernelLibrary<double> {
    static auto kernels() { return cpu64::kernels(); }
    static bool setVariant(std::string_view name, double value) { return cpu64::setVariant(name, value); }
    static void resetVariants() { cpu64::resetVariants(); }
};

template <class Real>
const CpuKernel<Real>& findKernel(const std::string& entry)
{
    for (const CpuKernel<Real>& kernel : KernelLibrary<Real>::kernels()) {
        if (kernel.entry == entry) return kernel;
    }
    throw ShaderError(fmt::format("{}: not among the passes that are compiled as C++", entry));
}

template <class Real>
class CpuDevice final : public Device {
  public:
    Fingerprint fingerprint() const override
    {
        const bool isFloat = sizeof(Real) == sizeof(float);
        return {isFloat ? "cpu32" : "cpu64", "none", isFloat ? "C++ float" : "C++ double",
                "g++ " __VERSION__,          "",     readCpuInfo()};
    }

    Precision precision() const override
    {
        return sizeof(Real) == sizeof(float) ? Precision::kFloat : Precision::kDouble;
    }

    JobResult run(const Job& job) override
    {
        JobResult result;
        Stopwatch watch;
        std::vector<std::vector<Real>> images;
        for (const ImageDesc& image : job.images)
            images.emplace_back(image.texels.begin(), image.texels.end());
        std::vector<std::vector<Real>> buffers;
        for (const BufferDesc& buffer : job.buffers)
            buffers.emplace_back(buffer.scalarCount, Real(0));
        result.times.upload = watch.lap();

        for (const DispatchDesc& dispatch : job.dispatches)
            runDispatch(job, dispatch, images, buffers);
        result.times.dispatch = watch.lap();

        for (size_t index : job.readbacks) {
            result.readbacks.emplace_back(buffers.at(index).begin(), buffers.at(index).end());
        }
        result.times.readback = watch.lap();
        return result;
    }

  private:
    static void runDispatch(const Job& job, const DispatchDesc& dispatch, std::vector<std::vector<Real>>& images,
                            std::vector<std::vector<Real>>& buffers)
    {
        const ProgramSource& program = job.programs.at(dispatch.program);
        const CpuKernel<Real>& kernel = findKernel<Real>(program.entry);
        KernelLibrary<Real>::resetVariants();
        for (const auto& [name, value] : program.specialization) {
            if (!KernelLibrary<Real>::setVariant(name, value)) {
                throw ShaderError(fmt::format("{}: no specialization constant \"{}\"", program.entry, name));
            }
        }
        CpuBindings<Real> bindings;
        for (const Binding& binding : dispatch.bindings) {
            if (binding.binding >= kMaxCpuBindings) {
                throw ShaderError(
                    fmt::format("{}: binding {} is beyond {}", program.entry, binding.binding, kMaxCpuBindings - 1));
            }
            if (binding.what == Binding::What::kImage) {
                const ImageDesc& image = job.images.at(binding.index);
                bindings.resources[binding.binding] = {images[binding.index].data(), image.width, image.height,
                                                       image.channels, images[binding.index].size()};
            } else if (job.buffers.at(binding.index).kind == BufferKind::kUniform) {
                bindings.uniforms[binding.binding] = job.buffers[binding.index].bytes;
            } else {
                bindings.resources[binding.binding] = {buffers[binding.index].data(), 0, 0, 1,
                                                       buffers[binding.index].size()};
            }
        }
        kernel.bind(bindings);
        const int sizeX = static_cast<int>(dispatch.groupsX * kernel.localSizeX);
        const int sizeY = static_cast<int>(dispatch.groupsY * kernel.localSizeY);
        for (int y = 0; y < sizeY; ++y) {
            for (int x = 0; x < sizeX; ++x)
                kernel.invoke(x, y);
        }
    }
};

} // namespace

std::unique_ptr<Device> makeCpuDevice(Precision precision)
{
    if (precision == Precision::kFloat) return std::make_unique<CpuDevice<float>>();
    return std::make_unique<CpuDevice<double>>();
}

} // namespace crossray
