#include "harness/run/job_codec.h"

#include "harness/base/bytes.h"
#include "harness/base/error.h"
#include "harness/run/worker_pool.h"

#include <fmt/format.h>

namespace crossray {

namespace {

constexpr uint32_t kJobMark = 0x314a5243;    // "CRJ1"
constexpr uint32_t kResultMark = 0x31525243; // "CRR1"
constexpr uint32_t kGreetingMark = 0x31475243;

void putMark(ByteWriter& writer, uint32_t mark)
{
    writer.put(mark);
}

void getMark(ByteReader& reader, uint32_t mark)
{
    if (reader.get<uint32_t>() != mark) throw InputError("malformed data: it bears another mark");
}

void putBool(ByteWriter& writer, bool value)
{
    writer.put<uint8_t>(value ? 1 : 0);
}

void putNumbers(ByteWriter& writer, const std::vector<double>& values, Precision precision)
{
    putBool(writer, precision == Precision::kDouble);
    if (precision == Precision::kDouble) {
        writer.putVector(values);
    } else {
        writer.putAsFloats(values);
    }
}

std::vector<double> getNumbers(ByteReader& reader)
{
    return reader.getBool() ? reader.getVector<double>() : reader.getFloatsAsDoubles();
}

// A member of an enumeration whose last one is `last`.
template <typename Enum>
Enum getEnum(ByteReader& reader, Enum last)
{
    const auto value = reader.get<uint8_t>();
    if (value > static_cast<uint8_t>(last)) throw InputError(fmt::format("malformed data: {} is no choice", value));
    return static_cast<Enum>(value);
}

template <typename Enum>
void putEnum(ByteWriter& writer, Enum value)
{
    writer.put(static_cast<uint8_t>(value));
}

void putProgram(ByteWriter& writer, const ProgramSource& program, const JobEncoding& encoding)
{
    writer.putString(program.key);
    const bool known = encoding.knownPrograms != nullptr && encoding.knownPrograms->count(program.key) > 0;
    putBool(writer, !known);
    if (known) return;
    const bool all = encoding.form == ProgramForm::kAll;
    writer.putString(program.entry);
    writer.put<uint64_t>(program.specialization.size());
    for (const auto& [name, value] : program.specialization) {
        writer.putString(name);
        writer.put(value);
    }
    writer.putVector(all || encoding.form == ProgramForm::kSpirv ? program.spirv : std::vector<uint32_t>{});
    writer.putString(all || encoding.form == ProgramForm::kGlsl ? program.glsl : std::string{});
}

ProgramSource getProgram(ByteReader& reader, const FindProgram& find, bool& complete)
{
    ProgramSource program;
    program.key = reader.getString();
    if (!reader.getBool()) {
        const ProgramSource* held = find ? find(program.key) : nullptr;
        complete = complete && held != nullptr;
        return held != nullptr ? *held : program;
    }
    program.entry = reader.getString();
    for (size_t count = reader.getCount(sizeof(uint64_t) + sizeof(double)); count > 0; --count) {
        std::string name = reader.getString();
        program.specialization[std::move(name)] = reader.get<double>();
    }
    program.spirv = reader.getVector<uint32_t>();
    program.glsl = reader.getString();
    return program;
}

void putImage(ByteWriter& writer, const ImageDesc& image, Precision precision)
{
    for (const int number : {image.width, image.height, image.channels, image.levels})
        writer.put<int32_t>(number);
    putEnum(writer, image.filter);
    putNumbers(writer, image.texels, precision);
}

ImageDesc getImage(ByteReader& reader)
{
    ImageDesc image;
    for (int* number : {&image.width, &image.height, &image.channels, &image.levels})
        *number = reader.get<int32_t>();
    image.filter = getEnum(reader, ImageFilter::kLinear);
    image.texels = getNumbers(reader);
    return image;
}

void putDispatch(ByteWriter& writer, const DispatchDesc& dispatch)
{
    writer.put<uint64_t>(dispatch.program);
    writer.put<uint64_t>(dispatch.bindings.size());
    for (const Binding& binding : dispatch.bindings) {
        writer.put(binding.binding);
        putEnum(writer, binding.what);
        writer.put<uint64_t>(binding.index);
    }
    for (const uint32_t groups : {dispatch.groupsX, dispatch.groupsY, dispatch.groupsZ})
        writer.put(groups);
}

// An index into `count` things.
size_t getIndex(ByteReader& reader, size_t count, const char* what)
{
    const auto index = reader.get<uint64_t>();
    if (index >= count) throw InputError(fmt::format("malformed job: {} {} of {}", what, index, count));
    return static_cast<size_t>(index);
}

DispatchDesc getDispatch(ByteReader& reader, const Job& job)
{
    DispatchDesc dispatch;
    dispatch.program = getIndex(reader, job.programs.size(), "program");
    dispatch.bindings.resize(reader.getCount(sizeof(uint32_t) + 1 + sizeof(uint64_t)));
    for (Binding& binding : dispatch.bindings) {
        binding.binding = reader.get<uint32_t>();
        binding.what = getEnum(reader, Binding::What::kBuffer);
        const bool isImage = binding.what == Binding::What::kImage;
        binding.index =
            getIndex(reader, isImage ? job.images.size() : job.buffers.size(), isImage ? "image" : "buffer");
    }
    for (uint32_t* groups : {&dispatch.groupsX, &dispatch.groupsY, &dispatch.groupsZ})
        *groups = reader.get<uint32_t>();
    return dispatch;
}

size_t roughSize(const Job& job, const JobEncoding& encoding)
{
    size_t size = 4096;
    for (const ProgramSource& program : job.programs)
        size += program.spirv.size() * 4 + program.glsl.size();
    for (const ImageDesc& image : job.images) {
        size += 64 + image.texels.size() * (encoding.precision == Precision::kDouble ? sizeof(double) : sizeof(float));
    }
    for (const BufferDesc& buffer : job.buffers)
        size += 64 + buffer.bytes.size();
    return size;
}

} // namespace

ProgramForm programFormOf(const std::string& backend)
{
    if (backend == "lavapipe" || backend == "swiftshader" || backend.starts_with("vulkan:")) return ProgramForm::kSpirv;
    if (backend == "osmesa" || backend == "softpipe" || backend == "egl") return ProgramForm::kGlsl;
    if (backend == "cpu32" || backend == "cpu64") return ProgramForm::kEntry;
    return ProgramForm::kAll;
}

std::vector<std::byte> encodeJob(const Job& job, const JobEncoding& encoding)
{
    ByteWriter writer;
    writer.reserve(roughSize(job, encoding));
    putMark(writer, kJobMark);
    writer.putString(job.label);
    writer.put<uint64_t>(job.programs.size());
    for (const ProgramSource& program : job.programs)
        putProgram(writer, program, encoding);
    writer.put<uint64_t>(job.images.size());
    for (const ImageDesc& image : job.images)
        putImage(writer, image, encoding.precision);
    writer.put<uint64_t>(job.buffers.size());
    for (const BufferDesc& buffer : job.buffers) {
        putEnum(writer, buffer.kind);
        writer.putVector(buffer.bytes);
        writer.put<uint64_t>(buffer.scalarCount);
    }
    writer.put<uint64_t>(job.dispatches.size());
    for (const DispatchDesc& dispatch : job.dispatches)
        putDispatch(writer, dispatch);
    writer.put<uint64_t>(job.readbacks.size());
    for (const size_t readback : job.readbacks)
        writer.put<uint64_t>(readback);
    return writer.take();
}

DecodedJob decodeJob(std::span<const std::byte> bytes, const FindProgram& find)
{
    ByteReader reader(bytes);
    DecodedJob decoded;
    Job& job = decoded.job;
    getMark(reader, kJobMark);
    job.label = reader.getString();
    // The counts bound what is allocated by what the bytes can hold: each element takes at least so much.
    for (size_t count = reader.getCount(9); count > 0; --count)
        job.programs.push_back(getProgram(reader, find, decoded.complete));
    for (size_t count = reader.getCount(26); count > 0; --count)
        job.images.push_back(getImage(reader));
    for (size_t count = reader.getCount(17); count > 0; --count) {
        BufferDesc buffer;
        buffer.kind = getEnum(reader, BufferKind::kStorage);
        buffer.bytes = reader.getVector<std::byte>();
        buffer.scalarCount = static_cast<size_t>(reader.get<uint64_t>());
        job.buffers.push_back(std::move(buffer));
    }
    for (size_t count = reader.getCount(28); count > 0; --count)
        job.dispatches.push_back(getDispatch(reader, job));
    for (size_t count = reader.getCount(8); count > 0; --count) {
        job.readbacks.push_back(getIndex(reader, job.buffers.size(), "readback of buffer"));
    }
    reader.finish();
    return decoded;
}

std::vector<std::byte> encodeJob(const Job& job)
{
    return encodeJob(job, JobEncoding{});
}

Job decodeJob(std::span<const std::byte> bytes)
{
    DecodedJob decoded = decodeJob(bytes, nullptr);
    if (!decoded.complete) throw InputError("malformed job: a program has no code");
    return std::move(decoded.job);
}

std::vector<std::byte> encodeResult(const JobResult& result, Precision precision)
{
    ByteWriter writer;
    putMark(writer, kResultMark);
    writer.put<uint64_t>(result.readbacks.size());
    for (const std::vector<double>& values : result.readbacks)
        putNumbers(writer, values, precision);
    const JobTimes& times = result.times;
    for (const double time : {times.program, times.upload, times.dispatch, times.readback, times.device})
        writer.put(time);
    putBool(writer, result.programsWereWarm);
    writer.put<uint64_t>(result.messages.size());
    for (const std::string& message : result.messages)
        writer.putString(message);
    return writer.take();
}

JobResult decodeResult(std::span<const std::byte> bytes)
{
    ByteReader reader(bytes);
    JobResult result;
    getMark(reader, kResultMark);
    for (size_t count = reader.getCount(9); count > 0; --count)
        result.readbacks.push_back(getNumbers(reader));
    JobTimes& times = result.times;
    for (double* time : {&times.program, &times.upload, &times.dispatch, &times.readback, &times.device})
        *time = reader.get<double>();
    result.programsWereWarm = reader.getBool();
    for (size_t count = reader.getCount(8); count > 0; --count)
        result.messages.push_back(reader.getString());
    reader.finish();
    return result;
}

std::vector<std::byte> encodeGreeting(const WorkerGreeting& greeting)
{
    ByteWriter writer;
    putMark(writer, kGreetingMark);
    const Fingerprint& print = greeting.fingerprint;
    for (const std::string* text :
         {&print.backend, &print.api, &print.device, &print.driver, &print.llvm, &print.cpu}) {
        writer.putString(*text);
    }
    putEnum(writer, greeting.precision);
    return writer.take();
}

WorkerGreeting decodeGreeting(std::span<const std::byte> bytes)
{
    ByteReader reader(bytes);
    WorkerGreeting greeting;
    getMark(reader, kGreetingMark);
    Fingerprint& print = greeting.fingerprint;
    for (std::string* text : {&print.backend, &print.api, &print.device, &print.driver, &print.llvm, &print.cpu}) {
        *text = reader.getString();
    }
    greeting.precision = getEnum(reader, Precision::kDouble);
    reader.finish();
    return greeting;
}

} // namespace crossray
