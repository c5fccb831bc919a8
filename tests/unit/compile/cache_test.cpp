#include "harness/compile/cache.h"

#include "harness/base/error.h"
#include "tests/unit/compile/shader_folder.h"

#include <gtest/gtest.h>

#include <functional>

using namespace crossray;

namespace {

constexpr const char* kIncluding = "#version 450\n#include \"lib/value.glsl\"\nlayout(local_size_x = 1) in;\n"
                                   "layout(binding = 0) buffer B { float a[]; };\nvoid main() { a[0] = value(); }\n";

std::vector<std::filesystem::path> filesBelow(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    return files;
}

std::string readAll(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

class CompileCache : public testing::Test {
  protected:
    void SetUp() override
    {
        folder.write("a.comp", kIncluding);
        folder.write("lib/value.glsl", "float value() { return 1.5; }\n");
    }
    // By a compiler that has nothing in memory.
    CompiledShader compileAnew() { return ShaderCompiler(folder.cache()).compile("a.comp", folder.options()); }
    ShaderFolder folder;
};

} // namespace

TEST_F(CompileCache, answersWithTheSameShader)
{
    const CompiledShader first = compileAnew();
    const CompiledShader second = compileAnew();
    EXPECT_FALSE(first.fromCache);
    EXPECT_TRUE(second.fromCache);
    EXPECT_EQ(first.spirv, second.spirv);
    EXPECT_EQ(first.glsl, second.glsl);
    EXPECT_EQ(first.key, second.key);
    EXPECT_EQ(first.localSize, second.localSize);
    EXPECT_EQ(first.closure, second.closure);
    EXPECT_EQ(filesBelow(folder.cache()).size(), 2u);
}

TEST_F(CompileCache, seesAChangeOfAnIncludedFile)
{
    ShaderCompiler compiler(folder.cache());
    const CompiledShader first = compiler.compile("a.comp", folder.options());
    EXPECT_TRUE(compiler.compile("a.comp", folder.options()).fromCache);
    folder.write("lib/value.glsl",
                 "float value() { return 2.5; }\n"); // the same size, within the same tick of the clock
    const CompiledShader second = compiler.compile("a.comp", folder.options());
    EXPECT_FALSE(second.fromCache);
    EXPECT_NE(second.key, first.key);
    EXPECT_NE(second.spirv, first.spirv);
    folder.write("lib/value.glsl", "float value() { return 1.5; }\n");
    EXPECT_EQ(compileAnew().spirv, first.spirv);
}

// The clock of a file system ticks in milliseconds: two writes within a tick leave the same time.
TEST_F(CompileCache, answersFromMemoryWithoutReadingSettledFiles)
{
    const auto longAgo = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
    for (const auto& file : filesBelow(folder.options().includeRoot))
        std::filesystem::last_write_time(file, longAgo);
    ShaderCompiler compiler({});
    EXPECT_FALSE(compiler.compile("a.comp", folder.options()).fromCache);
    for (int i = 0; i < 3; ++i)
        EXPECT_TRUE(compiler.compile("a.comp", folder.options()).fromCache);
    folder.write("lib/value.glsl", "float value() { return 2.5; }\n");
    EXPECT_FALSE(compiler.compile("a.comp", folder.options()).fromCache);
    std::filesystem::remove(folder.options().includeRoot / "lib/value.glsl");
    EXPECT_THROW(compiler.compile("a.comp", folder.options()), ShaderError);
}

TEST_F(CompileCache, optionsAreOtherEntries)
{
    std::vector<std::string> keys{compileAnew().key};
    for (const auto& change : std::vector<std::function<void(CompileOptions&)>>{
             [](auto& options) { options.optimize = false; }, [](auto& options) { options.debugInfo = true; }}) {
        CompileOptions options = folder.options();
        change(options);
        const CompiledShader shader = ShaderCompiler(folder.cache()).compile("a.comp", options);
        EXPECT_FALSE(shader.fromCache);
        for (const std::string& key : keys)
            EXPECT_NE(shader.key, key);
        keys.push_back(shader.key);
    }
}

TEST_F(CompileCache, keyIsThatOfTheContentWhereverItLies)
{
    const ShaderFolder other;
    other.write("a.comp", kIncluding);
    other.write("lib/value.glsl", "float value() { return 1.5; }\n");
    EXPECT_EQ(ShaderCompiler({}).compile("a.comp", other.options()).key, compileAnew().key);
}

TEST_F(CompileCache, brokenEntriesAreMadeAnew)
{
    const CompiledShader first = compileAnew();
    for (const std::filesystem::path& file : filesBelow(folder.cache())) {
        const std::string whole = readAll(file);
        const auto expectRemade = [&](const std::string& content, const std::string& what) {
            std::ofstream(file, std::ios::binary | std::ios::trunc) << content;
            const CompiledShader again = compileAnew();
            EXPECT_FALSE(again.fromCache) << what;
            EXPECT_EQ(again.spirv, first.spirv) << what;
            EXPECT_EQ(readAll(file), whole) << what;
        };
        for (const size_t size : {size_t{0}, size_t{7}, size_t{20}, whole.size() / 2, whole.size() - 1}) {
            expectRemade(whole.substr(0, size), "truncated to " + std::to_string(size));
        }
        expectRemade(whole + "x", "with a tail");
        std::string changed = whole;
        changed[8] = static_cast<char>(changed[8] + 1);
        expectRemade(changed, "of another format version");
        changed = whole;
        changed.back() = static_cast<char>(changed.back() ^ 1);
        expectRemade(changed, "with a flipped bit");
        expectRemade("#!/bin/sh\n", "foreign");
    }
}

TEST_F(CompileCache, entriesUnderAnotherKeyAreNotTrusted)
{
    const FileCache cache(folder.cache());
    const std::vector<std::byte> payload(5, std::byte{7});
    cache.store({1, 2}, payload);
    EXPECT_EQ(cache.find({1, 2}), payload);
    EXPECT_EQ(cache.find({1, 3}), std::nullopt);
    const std::filesystem::path file = filesBelow(folder.cache()).at(0);
    const std::filesystem::path moved = file.parent_path() / Hash128{1, 3}.hex();
    std::filesystem::rename(file, moved);
    EXPECT_EQ(cache.find({1, 3}), std::nullopt);
}

TEST_F(CompileCache, anUnusableFolderIsNoError)
{
    const std::filesystem::path file = folder.root() / "file";
    std::ofstream(file) << "not a folder";
    for (const std::filesystem::path& place : {file, file / "below", std::filesystem::path("/proc/crossray")}) {
        ShaderCompiler compiler(place);
        EXPECT_FALSE(compiler.compile("a.comp", folder.options()).fromCache);
        EXPECT_TRUE(compiler.compile("a.comp", folder.options()).fromCache);
    }
}

TEST_F(CompileCache, hitsTakeWellUnderAMillisecond)
{
    compileAnew();
    double best = 1e9;
    for (int i = 0; i < 20; ++i)
        best = std::min(best, compileAnew().milliseconds);
    EXPECT_LT(best, 1.0);
    RecordProperty("milliseconds", std::to_string(best));
}
