// Jobs and their answers as bytes, for the pipe between the pool and a worker.
#pragma once

#include "harness/backend/device.h"

#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace crossray {

// Which form of a program a worker's device reads.
enum class ProgramForm { kAll, kSpirv, kGlsl, kEntry };
ProgramForm programFormOf(const std::string& backend);

struct JobEncoding {
    Precision precision = Precision::kDouble; // kFloat: texels travel as floats, at half the size
    ProgramForm form = ProgramForm::kAll;
    const std::set<std::string>* knownPrograms = nullptr; // keys whose code the receiver holds already
};
std::vector<std::byte> encodeJob(const Job& job, const JobEncoding& encoding);

// Gives the code of a program that the sender left out, or nothing when it is not held.
using FindProgram = std::function<const ProgramSource*(const std::string& key)>;
struct DecodedJob {
    Job job;
    bool complete = true; // false: a program's code is neither in the bytes nor held
};
// Throws InputError on anything malformed.
DecodedJob decodeJob(std::span<const std::byte> bytes, const FindProgram& find);

std::vector<std::byte> encodeResult(const JobResult& result, Precision precision);
JobResult decodeResult(std::span<const std::byte> bytes);

// What a worker says when its device is open.
struct WorkerGreeting {
    Fingerprint fingerprint;
    Precision precision = Precision::kFloat;
};
std::vector<std::byte> encodeGreeting(const WorkerGreeting& greeting);
WorkerGreeting decodeGreeting(std::span<const std::byte> bytes);

} // namespace crossray
