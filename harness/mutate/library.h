// The shader library in memory, and its programs with one file changed: parsed once an entry, optimised once a variant,
// by the steps of ShaderCompiler without what no device here reads (GLSL, files).
#pragma once

#include "harness/backend/device.h"
#include "harness/compile/compile.h"
#include "harness/compile/source.h"
#include "harness/mutate/spirv_reach.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace crossray {

// What a job's program is made of.
struct ProgramKey {
    std::string entry; // "entry/screen_trace.comp"
    std::filesystem::path ownTracer;
    std::map<std::string, double> specialization;
    auto operator<=>(const ProgramKey&) const = default;
};

// A file of the library with other text.
struct ChangedFile {
    std::string name; // below the shader folder
    std::string text;
};

class MutantLibrary {
  public:
    // Reads every file below the folder.
    explicit MutantLibrary(std::filesystem::path shaderRoot);

    const std::filesystem::path& root() const { return root_; }
    std::vector<std::string> fileNames() const;               // sorted, all that end in .glsl
    const std::string& textOf(const std::string& name) const; // throws InputError for one that is not there

    // Names of the files of an entry, and the functions that a variant may reach: what its constants rule out is left
    // out. Functions of the source by name; overloads share theirs.
    const std::set<std::string>& closureOf(const ProgramKey& program);
    const std::set<std::string>& reachOf(const ProgramKey& program);
    // The program as it is.
    const std::vector<uint32_t>& compile(const ProgramKey& program);
    // Whether the optimised program holds any instruction of these functions of the file.
    bool holds(const ProgramKey& program, const std::string& file, const std::set<std::string>& functions);

  private:
    struct Parsed {
        std::vector<uint32_t> spirv;
        std::shared_ptr<const SpirvReach> functions;
        std::set<std::string> closure;
    };

  public:
    // One mutant: entries are parsed on first use. Not thread-safe; the library behind it is. Throws ShaderError where
    // the change does not compile.
    class Mutant {
      public:
        Mutant(MutantLibrary& library, ChangedFile change) : library_(library), change_(std::move(change)) {}
        std::vector<uint32_t> compile(const ProgramKey& program);

      private:
        MutantLibrary& library_;
        ChangedFile change_;
        std::map<std::pair<std::string, std::filesystem::path>, std::optional<Parsed>> parsed_;
    };

  private:
    struct Variant {
        std::set<std::string> mangled; // names of the functions as SPIR-V has them
        std::set<std::string> reach;
        // On first need:
        std::vector<uint32_t> spirv;
        std::map<std::string, std::set<uint32_t>> lines; // of each file, that its instructions come from
        bool isCompiled = false;
    };

    Parsed parse(const ProgramKey& program, const ChangedFile* change) const;
    const Parsed& parsedOf(const ProgramKey& program);
    Variant& variantOf(const ProgramKey& program);
    Variant& compiledOf(const ProgramKey& program);
    std::vector<uint32_t> finish(const Parsed& parsed, const ProgramKey& program) const;

    std::filesystem::path root_;
    std::map<std::string, SourceFile> files_;
    std::mutex mutex_; // guards the maps; what they point to has its own
    template <typename T>
    struct Slot {
        std::mutex making;
        bool done = false;
        T value;
    };
    std::map<std::pair<std::string, std::filesystem::path>, std::unique_ptr<Slot<Parsed>>> parsed_;
    std::map<ProgramKey, std::unique_ptr<Slot<Variant>>> variants_;
};

// Serves buildJob() from the library as it is. `listsOnly`: programs without code, for a job of which only the
// programs' names are wanted; a person's own tracer is compiled all the same, since its job hangs on its code.
class LibraryCompiler : public ShaderCompiler {
  public:
    LibraryCompiler(MutantLibrary& library, bool listsOnly)
        : ShaderCompiler({}), library_(library), listsOnly_(listsOnly)
    {
    }
    CompiledShader compile(const std::filesystem::path& shader, const CompileOptions& options) override;

  private:
    MutantLibrary& library_;
    bool listsOnly_;
};

// By content, so that equal code is one program in a worker.
std::string makeProgramKey(const std::vector<uint32_t>& spirv);

} // namespace crossray
