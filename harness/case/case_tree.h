// One case of a file as the tree of its keys, with some of them changed: what is built into a Case, shown as controls,
// and written as a case file of its own.
#pragma once

#include "harness/case/case.h"
#include "harness/case/node.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace crossray {

struct CaseTree {
    Node own;   // what a file of its own would say: presets are named in `use`, [expand] is resolved
    Node whole; // with the presets laid in
    Case testCase;
};

// Values by dotted path; of a list of numbers the whole, or one number by its index.
using KeyValues = std::map<std::string, Node>;

// The case of the name, or the file's only one, with these values set in the place of what the file, its presets and
// its [expand] say. A name without the brackets of a sub-case is enough where the values settle what the sub-cases
// differ in. Throws InputError as readCaseFile() does, and where the name stands for several cases.
CaseTree readCaseTree(const std::filesystem::path& file, const std::string& caseName, const KeyValues& values);

// The tree as TOML: what stands at the top level first, then its tables; numbers are those that are read back.
std::string formatToml(const Node& root);
// Whether two trees say the same, wherever it stands and in whatever order the keys of a table come.
bool saysTheSame(const Node& a, const Node& b);

// Writes the case as a file NAME.toml beside the file that it comes from, named by that one's folder and `word`; files
// that the case names are those that it names there. What is written has been read back and says the same. Never
// replaces a file. Throws InputError for a word that is none, AlreadyThere when a file or a case is called so, and
// EnvironmentError when it cannot be written.
struct SavedCase {
    std::filesystem::path file;
    std::string name;
};
SavedCase saveCase(const CaseTree& tree, const std::string& word, const std::filesystem::path& caseRoot);

class AlreadyThere : public InputError {
  public:
    using InputError::InputError;
};

} // namespace crossray
