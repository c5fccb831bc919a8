// A changed case as a file of its own.
#include "harness/case/case_tree.h"
#include "harness/case/key_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace crossray {

namespace fs = std::filesystem;

namespace {

constexpr size_t kLongestWord = 80;

// "refraction/" of "refraction/sphere[ior=1.5]".
std::string folderOf(const std::string& caseName)
{
    const std::string base = caseName.substr(0, caseName.find('['));
    const size_t slash = base.rfind('/');
    return slash == std::string::npos ? "" : base.substr(0, slash + 1);
}

// The word alone, or behind the folder that the case itself has.
std::string takeWord(const std::string& given, const std::string& folder)
{
    const std::string word = !folder.empty() && given.starts_with(folder) ? given.substr(folder.size()) : given;
    const bool isWord =
        !word.empty() && word.size() <= kLongestWord && std::all_of(word.begin(), word.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
        });
    if (isWord) return word;
    throw InputError(fmt::format("the name is no word; at most {} of a-z, 0-9 and _ are allowed{}", kLongestWord,
                                 folder.empty() ? "" : fmt::format(", \"{}\" may stand before them", folder)));
}

void refuseKnownName(const std::string& name, const fs::path& folder)
{
    for (const fs::path& file : findCaseFiles(folder)) {
        try {
            const Node root = readTomlFile(file);
            const Node* const other = root.find("name");
            if (other != nullptr && other->text == name)
                throw AlreadyThere({file.string()},
                                   fmt::format("is called \"{}\" already; another name is allowed", name));
        } catch (const AlreadyThere&) {
            throw;
        } catch (const InputError&) { // a broken file has no name to collide with
        }
    }
}

// Without a file of its own a baked probe is found by the name of the case file, which is another now.
void keepBakedFiles(Node& root, const Case& testCase)
{
    const Node* const probes = root.find("probe");
    for (size_t i = 0; probes != nullptr && i < probes->items.size(); ++i) {
        const Node* const capture = findByPath(probes->items[i], "environment.capture");
        if (capture == nullptr || capture->text != "baked" ||
            findByPath(probes->items[i], "environment.file") != nullptr)
            continue;
        Node file;
        file.kind = NodeKind::kString;
        file.text = fmt::format("{}.probe{}.exr", testCase.file.stem().string(), i + 1);
        setByPath(root, fmt::format("probe.{}.environment.file", i), {}, file);
    }
}

void setName(Node& root, const std::string& name)
{
    Node value;
    value.kind = NodeKind::kString;
    value.text = name;
    setByPath(root, "name", {}, value);
}

// A file that is being written; it is gone unless it was put in place.
class Draft {
  public:
    Draft(const fs::path& target, std::string_view text)
        : file_(target.parent_path() / fmt::format(".{}.{}.draft", target.filename().string(), ::getpid()))
    {
        const int fd = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd < 0) fail("cannot be written");
        bool isWhole = true;
        while (!text.empty() && isWhole) {
            const ssize_t written = ::write(fd, text.data(), text.size());
            isWhole = written > 0;
            if (isWhole) text.remove_prefix(static_cast<size_t>(written));
        }
        isWhole = isWhole && ::fsync(fd) == 0;
        ::close(fd);
        if (!isWhole) {
            ::unlink(file_.c_str());
            fail("cannot be written");
        }
    }
    ~Draft() { ::unlink(file_.c_str()); }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;

    const fs::path& file() const { return file_; }
    // A link is made or is refused: it never replaces.
    void putInPlace(const fs::path& target) const
    {
        if (::link(file_.c_str(), target.c_str()) == 0) return;
        if (errno == EEXIST) throw AlreadyThere({target.string()}, "is there already; another name is allowed");
        fail("cannot be put in place");
    }

  private:
    [[noreturn]] void fail(std::string_view what) const
    {
        throw EnvironmentError(fmt::format("{}: {}: {}", file_.string(), what, std::strerror(errno)));
    }

    fs::path file_;
};

} // namespace

SavedCase saveCase(const CaseTree& tree, const std::string& word, const fs::path& caseRoot)
{
    const std::string folder = folderOf(tree.testCase.name);
    SavedCase saved;
    saved.name = folder + takeWord(word, folder);
    saved.file = tree.testCase.file.parent_path() / (saved.name.substr(folder.size()) + ".toml");
    std::error_code ignored;
    if (fs::exists(fs::symlink_status(saved.file, ignored)))
        throw AlreadyThere({saved.file.string()}, "is there already; another name is allowed");
    refuseKnownName(saved.name, caseRoot);

    Node own = tree.own, whole = tree.whole;
    for (Node* root : {&own, &whole}) {
        keepBakedFiles(*root, tree.testCase);
        setName(*root, saved.name);
        root->erase("expand");
    }
    const std::string text = fmt::format("# From {}, with some of its keys changed by `crossray inspect`.\n{}",
                                         tree.testCase.name, formatToml(own));
    const Draft draft(saved.file, text);
    Node again = readCaseTree(draft.file(), saved.name, {}).whole;
    for (Node* root : {&again, &whole})
        root->erase("use"); // what it names is laid in
    if (!saysTheSame(again, whole)) throw std::logic_error("the case does not say the same when it is read again");
    draft.putInPlace(saved.file);
    return saved;
}

} // namespace crossray
