// The page's logic in node, and the page in a browser; each is skipped where there is none.
#include "harness/base/text.h"
#include "harness/base/temporary_folder.h"
#include "tests/unit/report/report_fixture.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdlib>

using namespace crossray;

namespace fs = std::filesystem;

namespace {

// A stub that only says how to install the program counts as none.
bool isInstalled(const std::string& program)
{
    return std::system(fmt::format("{} --version >/dev/null 2>&1", program).c_str()) == 0;
}

// What a person does, in the page itself: its findings are left in the document for --dump-dom.
constexpr const char* kPerson = R"(
<script>
// In virtual time a browser without a window may come to no frame at all.
requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()));
</script>
<script type="module">
const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const until = async (what) => { for (let i = 0; i < 100 && !what(); ++i) await wait(20); };
const one = (query) => document.querySelector(query);
const key = (name, more = {}) => document.body.dispatchEvent(new KeyboardEvent('keydown', { key: name, bubbles: true, ...more }));
const row = (name) => [...document.querySelectorAll('.values tbody tr')].find((each) => each.firstChild.textContent === name)?.textContent;
const found = { errors: [] };
addEventListener('error', (event) => found.errors.push(String(event.message)));
addEventListener('unhandledrejection', (event) => found.errors.push(String(event.reason)));
await until(() => document.querySelectorAll('canvas').length === 3);
found.first = one('.case-title h2').textContent;
found.panes = document.querySelectorAll('canvas').length;
found.worst = row('osmesa');
found.expected = row('expected');
found.difference = one('.pane.difference .facts').textContent;
found.actual = one('.pane.actual .facts').textContent;
const canvas = one('.pane.actual canvas');
await wait(100);
const bounds = canvas.getBoundingClientRect();
const zoom = Math.min(bounds.width / 4, bounds.height / 2);
const at = { clientX: bounds.left + bounds.width / 2 + 0.5 * zoom, clientY: bounds.top + bounds.height / 2 - 0.5 * zoom, pointerId: 1, bubbles: true };
canvas.setPointerCapture = () => {};
canvas.dispatchEvent(new PointerEvent('pointerdown', at));
canvas.dispatchEvent(new PointerEvent('pointerup', at));
await wait(50);
found.clicked = [...document.querySelectorAll('.coordinates input')].map((input) => input.value).join();
found.nan = row('osmesa');
const colorThere = () => [...canvas.getContext('2d').getImageData(Math.round((at.clientX - bounds.left) * devicePixelRatio + 12),
  Math.round((at.clientY - bounds.top) * devicePixelRatio + 12), 1, 1).data.slice(0, 3)].join();
await until(() => colorThere() === '255,0,255'); // painted in a frame to come
found.nanColor = colorThere();
key('u');
await wait(50);
found.afterU = [...document.querySelectorAll('.coordinates input')].map((input) => input.value).join();
key('b');
await wait(50);
found.blink = document.querySelectorAll('canvas').length;
key('b');
key('2');
await wait(50);
found.output = one('.tab[aria-pressed=true][aria-keyshortcuts]').textContent;
key('1');
one('#filter').value = 's:crash';
one('#filter').dispatchEvent(new Event('input'));
await wait(200);
found.filtered = [...document.querySelectorAll('[role=option] .name')].map((each) => each.textContent).join();
found.hash = location.hash;
key(']');
key('?');
await wait(50);
found.help = one('dialog').open;
one('dialog').close();
one('#filter').value = '';
one('#filter').dispatchEvent(new Event('input'));
one('#skip').click();
found.skipped = document.activeElement.id;
found.case = one('.case-title h2').textContent;
found.commands = one('#commands').textContent;
document.body.append(Object.assign(document.createElement('pre'), { id: 'found', textContent: JSON.stringify(found) }));
</script>
)";

std::string unescapeHtml(std::string text)
{
    for (const auto& [from, to] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&amp;", "&"}}) {
        for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + 1))
            text.replace(at, std::string(from).size(), to);
    }
    return text;
}

class BrowserTest : public testing::Test {
  protected:
    void SetUp() override
    {
        if (!isInstalled("chromium"))
            GTEST_SKIP() << "chromium is not installed: the page is tested by its logic alone";
    }

    // The document after its scripts, with what kPerson found.
    nlohmann::json visit(const fs::path& page) const
    {
        const fs::path dump = folder_.path() / "dom.html", log = folder_.path() / "log.txt";
        const std::string command =
            fmt::format("timeout 120 chromium --headless=new --no-sandbox --disable-gpu --user-data-dir={0}/profile "
                        "--window-size=1400,900 --virtual-time-budget=20000 --enable-logging=stderr --dump-dom "
                        "'file://{1}' >{2} 2>{3}",
                        folder_.path().string(), fs::absolute(page).string(), dump.string(), log.string());
        EXPECT_EQ(std::system(command.c_str()), 0) << readText(log).value_or("");
        const std::string errors = readText(log).value_or("");
        EXPECT_EQ(errors.find("Uncaught"), std::string::npos) << errors;
        const std::string document = readText(dump).value_or(""), open = "<pre id=\"found\">";
        const size_t start = document.find(open);
        if (start == std::string::npos) {
            ADD_FAILURE() << "the page did not get to its end\n" << errors;
            return {};
        }
        const size_t end = document.find("</pre>", start);
        return nlohmann::json::parse(unescapeHtml(document.substr(start + open.size(), end - start - open.size())));
    }

    void check(const nlohmann::json& found) const
    {
        EXPECT_EQ(found["errors"].size(), 0u) << found["errors"];
        EXPECT_EQ(found["first"], "hiz/far_depth");
        EXPECT_EQ(found["panes"], 3);
        // The worst pixel by the judge, and what the planes have there.
        EXPECT_EQ(found["expected"], "expected2.540200000");
        EXPECT_EQ(found["worst"], "osmesa3404000002097152"
                                  "0.2");
        EXPECT_EQ(found["difference"], "2 px beyond · max 0.2 relative · 1 without a number");
        EXPECT_EQ(found["actual"], "1 … 3 · 1 NaN");
        EXPECT_EQ(found["clicked"], "2,0");
        EXPECT_EQ(found["nan"], "osmesaNaN7fc00000∞∞");
        EXPECT_EQ(found["nanColor"], "255,0,255");
        EXPECT_EQ(found["afterU"], "1,1");
        EXPECT_EQ(found["blink"], 2);
        EXPECT_EQ(found["output"], "2RayDirWS");
        EXPECT_EQ(found["filtered"], "refraction/crashes");
        EXPECT_NE(found["hash"].get<std::string>().find("f=s%3Acrash"), std::string::npos) << found["hash"];
        EXPECT_TRUE(found["help"]);
        EXPECT_EQ(found["skipped"], "panes");
        EXPECT_EQ(found["case"], "refraction/crashes"); // the only one under the filter
        EXPECT_NE(found["commands"].get<std::string>().find("crossray run "), std::string::npos);
    }

    fs::path write(bool isSingle) const
    {
        ReportOptions options;
        options.isSingle = isSingle;
        for (auto& [name, content] : ReportFixture().make(options)) {
            fs::create_directories((folder_.path() / name).parent_path());
            const bool isPage = name == "index.html";
            std::ofstream(folder_.path() / name) << content << (isPage ? kPerson : "");
        }
        return folder_.path() / "index.html";
    }

    TemporaryFolder folder_{"crossray_web_test"};
};

} // namespace

TEST(WebLogic, holdsInNode)
{
    if (!isInstalled("node")) GTEST_SKIP() << "node is not installed";
    const std::string command = "node --test " CROSSRAY_SOURCE_DIR "/tests/web/*.test.mjs 2>&1";
    FILE* const pipe = popen(command.c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    std::string output(1 << 16, '\0');
    output.resize(fread(output.data(), 1, output.size(), pipe));
    EXPECT_EQ(pclose(pipe), 0) << output;
}

TEST_F(BrowserTest, folderOpensFromDisk)
{
    check(visit(write(false)));
}

TEST_F(BrowserTest, singleFileOpensFromDisk)
{
    const fs::path page = write(true);
    EXPECT_FALSE(fs::exists(folder_.path() / "data"));
    check(visit(page));
}
