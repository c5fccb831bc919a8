// What the routes answer, without the network.
#include "tests/unit/inspector/inspector_fixture.h"

#include "harness/inspector/controls.h"

#include <csignal>
#include <future>
#include <thread>

#include <sys/types.h>

using namespace crossray;

namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

class InspectorTest : public InspectorFixture {
  protected:
    Json controlOf(const std::string& testCase, const std::string& path)
    {
        const Json controls = parse(inspector_->controls(testCase))["controls"];
        for (const Json& control : controls) {
            if (control["path"] == path) return control;
        }
        return nullptr;
    }
    // Asks until the renderer is busy with something of this name.
    void waitUntilBusy(const std::string& what)
    {
        for (int i = 0; i < 5000; ++i) {
            const Json progress = parse(inspector_->progress());
            if (progress["busy"] && progress["what"].get<std::string>().starts_with(what)) return;
            std::this_thread::sleep_for(2ms);
        }
        FAIL() << "it never was busy with " << what;
    }
};

} // namespace

TEST_F(InspectorTest, rendersAsTheFileSays)
{
    const Reply reply = inspector_->render(question("floor", {{"backends", {"cpu64", "cpu32"}}, {"generation", 7}}));
    ASSERT_EQ(reply.status, 200) << reply.body;
    const Json json = parse(reply);
    EXPECT_EQ(json["generation"], 7);
    EXPECT_EQ(json["item"]["name"], "floor");
    EXPECT_EQ(json["item"]["results"][0]["verdict"], "pass");
    EXPECT_EQ(json["item"]["planes"], json["planes"]);
    EXPECT_TRUE(json["milliseconds"]["backends"].contains("cpu32"));
    const Json planes = parsePlanes(inspector_->data(json["planes"]["cpu64"]));
    EXPECT_EQ(planes["width"], 16);
    std::vector<std::string> names;
    for (const Json& plane : planes["planes"])
        names.push_back(plane["name"]);
    EXPECT_EQ(names, (std::vector<std::string>{"RayDirWS", "HitSuccess"}));
    EXPECT_EQ(parsePlanes(inspector_->data(json["planes"]["expected"]))["planes"][0]["name"], "RayDirWS@0");
    const Json details = parse(inspector_->data(json["item"]["details"]));
    EXPECT_EQ(details[0]["name"], "floor");
    EXPECT_EQ(details[0]["backends"][0]["expectations"][0]["output"], "RayDirWS");
    EXPECT_EQ(inspector_->data("planes-99-0").status, 404);
}

TEST_F(InspectorTest, aChangedKeyIsAsIfTheFileSaidSo)
{
    const auto hits = [&](const Json& parameters) {
        const Json json = parse(inspector_->render(question("floor", {{"parameters", parameters}})));
        const Json planes = parsePlanes(inspector_->data(json["planes"]["cpu64"]));
        return std::pair<int, Json>(planes["width"], planes["planes"][1]["data"]);
    };
    const auto before = hits(Json::object());
    const auto moved = hits({{"camera.eye.0", 0.7}, {"projection.depth_bias", 0.1}});
    EXPECT_EQ(before.first, 16);
    EXPECT_NE(before.second, moved.second);
    EXPECT_EQ(hits({{"scene.size.0", 20}}).first, 20);
    EXPECT_EQ(hits(Json::object()), before); // what was kept of the others is not in it
    // The same from a file that says so.
    writeCase(
        "moved", "",
        "[[expect]]\noutput = \"RayDirWS\"\nanalytic = \"reflection_direction\"\ntolerance = { degrees = 1e-3 }\n");
    std::string text = *readText(folder_ / "moved.toml");
    text.replace(text.find("eye = [0,"), 9, "eye = [0.7,");
    text.replace(text.find("min_level = 0"), 13, "min_level = 0\ndepth_bias = 0.1");
    std::ofstream(folder_ / "moved.toml") << text;
    setup_.selected = readCaseFile(folder_ / "moved.toml");
    Inspector other(setup_);
    const Json json = parse(other.render(question("moved")));
    EXPECT_EQ(parsePlanes(other.data(json["planes"]["cpu64"]))["planes"][1]["data"], moved.second);
}

TEST_F(InspectorTest, whatIsKeptIsWhatWouldBeMadeAnew)
{
    const std::vector<Json> changes{
        {{"scene.primitives.1.center.0", 0.5}},       {{"projection.max_iterations", 3}}, {{"camera.fov", 40}},
        {{"scene.primitives.0.material", "diffuse"}}, {{"projection.model", "linear"}},   Json::object()};
    for (const Json& parameters : changes) {
        const auto pieces = [&](Inspector& inspector) {
            const Json json = parse(inspector.render(question("floor", {{"parameters", parameters}})));
            return parsePlanes(inspector.data(json["planes"]["cpu64"])).dump() +
                   parsePlanes(inspector.data(json["planes"]["expected"])).dump();
        };
        Inspector fresh(setup_);
        EXPECT_EQ(pieces(*inspector_), pieces(fresh)) << parameters;
        const std::string ask = question("floor", {{"parameters", parameters}, {"pixel", {8, 9}}});
        Json live = parse(inspector_->trace(ask)), first = parse(fresh.trace(ask));
        live.erase("milliseconds");
        first.erase("milliseconds");
        EXPECT_EQ(live, first) << parameters;
    }
}

TEST_F(InspectorTest, tracesOnOneBackendOrTwo)
{
    const Json one = parse(inspector_->trace(question("floor", {{"pixel", {8, 9}}})));
    EXPECT_EQ(one["schema"], "crossray-trace/1");
    EXPECT_EQ(one["pixel"], Json({8, 9}));
    EXPECT_EQ(one["backends"].size(), 1u);
    EXPECT_GT(one["backends"][0]["steps"].size(), 0u);
    EXPECT_TRUE(one["milliseconds"].contains("total"));
    const Json two = parse(inspector_->trace(question("floor", {{"pixel", {8, 9}}, {"backends", {"cpu64", "cpu32"}}})));
    EXPECT_EQ(two["backends"][1]["backend"], "cpu32");
    EXPECT_EQ(errorOf(inspector_->trace(question("floor", {{"pixel", {16, 0}}})), 422),
              "pixel 16,0 is outside the image of 16 x 12; allowed are 0,0 to 15,11");
}

TEST_F(InspectorTest, saysWhatIsWrongAndWhatIsAllowed)
{
    const auto render = [&](const std::string& body, int status) { return errorOf(inspector_->render(body), status); };
    EXPECT_EQ(render("{", 400).substr(0, 20), "the body is no JSON:");
    EXPECT_EQ(render("[1]", 400), "the body is no JSON object");
    EXPECT_EQ(render("\"\xff\"", 400).substr(0, 20), "the body is no JSON:");
    EXPECT_EQ(render("{}", 400), "\"case\" is missing");
    EXPECT_EQ(render(question("floor", {{"colour", 1}}), 400),
              "unknown field \"colour\"; allowed are case, parameters, backends, generation");
    EXPECT_EQ(render(question("floor", {{"parameters", 3}}), 400),
              "\"parameters\" is no object; allowed is {\"material.ior\": 1.5, ...}");
    EXPECT_EQ(render(question("floor", {{"parameters", {{"camera.fov", Json::array()}}}}), 400),
              "parameter \"camera.fov\": a number, a string, true or false is allowed");
    EXPECT_EQ(render(R"({"case":"floor","parameters":{"camera.fov":1e999},"backends":["cpu64"]})", 400).substr(0, 20),
              "the body is no JSON:");
    EXPECT_EQ(render(question("door"), 404), "there is no case \"door\" among those that are shown");
    EXPECT_EQ(render(question("floor", {{"backends", {"cuda"}}}), 422),
              "\"cuda\" is no backend; allowed are cpu64, cpu32, test");
    EXPECT_EQ(render(question("floor", {{"backends", Json::array()}}), 422), "0 backends; 1 to 3 are allowed");
    EXPECT_EQ(render(question("floor", {{"backends", {"cpu64", "cpu64"}}}), 422),
              "\"cpu64\" is twice among the backends; once is allowed");
    const auto change = [&](const std::string& path, const Json& value) {
        return render(question("floor", {{"parameters", {{path, value}}}}), 422);
    };
    EXPECT_EQ(change("camera.fov", 180), "camera.fov: \"fov\" is 180; above 0, below 180 is allowed");
    EXPECT_EQ(change("projection.max_iterations", 1.5),
              "projection.max_iterations: \"max_iterations\" is a number; an integer is allowed: 1 to 65535");
    EXPECT_EQ(change("projection.model", "magic").substr(0, 68),
              "projection.model: \"magic\" is no name for \"model\"; allowed: none, pro");
    EXPECT_EQ(change("camera.fvo", 60).substr(0, 71),
              "camera.fvo: \"camera.fvo\" is no key of the case format; did you mean \"ca");
    EXPECT_EQ(render(question("floor", {{"parameters", {{"scene.size.0", 4096}, {"scene.size.1", 4096}}}}), 422),
              "scene.size: 4096 x 4096 pixels; at most 4194304 are allowed here");
}

TEST_F(InspectorTest, controlsAreTheKeysWithTheirRanges)
{
    const Json fov = controlOf("floor", "camera.fov");
    EXPECT_EQ(fov["type"], "number");
    EXPECT_EQ(fov["value"], 60);
    EXPECT_EQ(fov["minimum"], 0);
    EXPECT_EQ(fov["exclusiveMaximum"], true);
    EXPECT_EQ(fov["unit"], "degrees");
    EXPECT_EQ(fov["group"], "camera");
    EXPECT_EQ(fov["when"]["values"], Json({"perspective"}));
    const Json iterations = controlOf("floor", "projection.max_iterations");
    EXPECT_EQ(iterations["type"], "integer");
    EXPECT_EQ(iterations["value"], 32);
    EXPECT_EQ(controlOf("floor", "projection.min_level")["value"], 0);
    EXPECT_EQ(controlOf("floor", "projection.min_level")["default"], 2);
    EXPECT_EQ(controlOf("floor", "scene.size.1")["value"], 12);
    EXPECT_EQ(controlOf("floor", "scene.size.1")["label"], "size height");
    EXPECT_EQ(controlOf("floor", "material.ior")["label"], "IOR");
    EXPECT_EQ(controlOf("floor", "scene.primitives.1.center.2")["value"], -4);
    EXPECT_EQ(controlOf("floor", "scene.primitives.0.material")["choices"], Json({"diffuse", "mirror", "glass"}));
    EXPECT_TRUE(controlOf("floor", "scene.primitives.1.cell_size").is_null());
    EXPECT_TRUE(controlOf("floor", "scene.seed").is_null());
    EXPECT_TRUE(controlOf("floor", "timeout").is_null());
    EXPECT_EQ(inspector_->controls("door").status, 404);
}

// Of cases of every kind: each control, set to the value that it shows, changes nothing and is taken.
TEST_F(InspectorTest, everyControlTakesItsOwnValue)
{
    size_t count = 0;
    std::map<std::string, int> seen; // by folder
    for (const std::filesystem::path& file : findCaseFiles(std::filesystem::path(CROSSRAY_SOURCE_DIR) / "cases")) {
        if (++seen[file.parent_path().filename().string()] > 12) continue;
        const std::string name = readCaseFile(file).front().name;
        const CaseTree tree = readCaseTree(file, name, {});
        for (const Control& control : listControls(tree)) {
            ASSERT_TRUE(control.value) << name << " " << control.path;
            ASSERT_NO_THROW({
                const CaseTree set = readCaseTree(file, name, {{control.path, *control.value}});
                EXPECT_EQ(set.testCase.camera, tree.testCase.camera) << name << " " << control.path;
                EXPECT_EQ(set.testCase.scene, tree.testCase.scene) << name << " " << control.path;
            }) << name
               << " " << control.path;
            ++count;
        }
    }
    EXPECT_GT(count, 1000u);
}

TEST_F(InspectorTest, aCrashIsAVerdictAndTheNextRequestWorks)
{
    const Json crashed = parse(inspector_->render(question("crash", {{"backends", {"test", "cpu64"}}})));
    EXPECT_EQ(crashed["item"]["results"][0]["verdict"], "crash");
    EXPECT_EQ(crashed["item"]["results"][0]["reason"], "signal 11 (Segmentation fault)");
    EXPECT_NE(crashed["item"]["results"][1]["verdict"], "crash");
    EXPECT_TRUE(crashed["planes"].contains("cpu64"));
    EXPECT_EQ(errorOf(inspector_->trace(question("crash", {{"pixel", {1, 1}}, {"backends", {"test"}}})), 422),
              "test: signal 11 (Segmentation fault)");
    EXPECT_EQ(inspector_->render(question("floor")).status, 200);
}

TEST_F(InspectorTest, aTimeOutIsAVerdictAndTheNextRequestWorks)
{
    // The worker hangs by the job's label, which is the case's name.
    const Json late =
        parse(inspector_->render(question("hang", {{"backends", {"test"}}, {"parameters", {{"timeout", 0.3}}}})));
    EXPECT_EQ(late["item"]["results"][0]["verdict"], "timeout");
    EXPECT_EQ(late["item"]["results"][0]["reason"], "no answer within 0.3 s");
    EXPECT_EQ(inspector_->render(question("floor")).status, 200);
}

TEST_F(InspectorTest, aKilledWorkerIsAVerdictAndTheNextRequestWorks)
{
    std::future<Reply> reply = std::async(std::launch::async, [&] {
        return inspector_->render(question("hang", {{"backends", {"test"}}}));
    });
    waitUntilBusy("running on test");
    std::vector<int> workers;
    for (int i = 0; i < 500 && workers.empty(); ++i) {
        workers = inspector_->renderer().pool().processIds("test");
        std::this_thread::sleep_for(10ms);
    }
    std::this_thread::sleep_for(200ms); // it has read the job by then
    ASSERT_EQ(workers.size(), 1u);
    ::kill(workers[0], SIGKILL);
    const Json json = parse(reply.get());
    EXPECT_EQ(json["item"]["results"][0]["verdict"], "crash");
    EXPECT_EQ(json["item"]["results"][0]["reason"], "signal 9 (Killed)");
    EXPECT_EQ(inspector_->render(question("floor")).status, 200);
}

TEST_F(InspectorTest, longWorkIsTheSubjectOfProgressAndCanBeCancelled)
{
    EXPECT_EQ(parse(inspector_->progress())["busy"], false);
    std::future<Reply> reply = std::async(std::launch::async, [&] {
        return inspector_->render(question("hang", {{"backends", {"test"}}}));
    });
    waitUntilBusy("running on test");
    EXPECT_EQ(parse(inspector_->progress())["total"], 1);
    EXPECT_EQ(parse(inspector_->cancel())["cancelled"], true);
    const Reply cancelled = reply.get();
    EXPECT_EQ(cancelled.status, 409);
    EXPECT_EQ(parse(cancelled)["cancelled"], true);
    EXPECT_EQ(inspector_->render(question("floor")).status, 200);
    EXPECT_EQ(parse(inspector_->cancel())["cancelled"], false);
}

TEST_F(InspectorTest, aNewerRenderTakesThePlaceOfOneThatHangs)
{
    std::future<Reply> old = std::async(std::launch::async, [&] {
        return inspector_->render(question("hang", {{"backends", {"test"}}}));
    });
    waitUntilBusy("running on test");
    EXPECT_EQ(inspector_->render(question("floor")).status, 200);
    const Reply superseded = old.get();
    EXPECT_EQ(superseded.status, 409);
    EXPECT_EQ(parse(superseded)["superseded"], true);
}

// Work in this process, too: the expected values of a large picture.
TEST_F(InspectorTest, theTruthOfALargePictureCanBeCancelled)
{
    writeCase("large", "",
              "[[expect]]\noutput = \"HitDepth\"\ntruth = \"hit_depth\"\ntolerance = { relative = 1e-3 }\n");
    setup_.selected = readCaseFile(folder_ / "large.toml");
    Inspector inspector(setup_);
    const std::string ask = question("large", {{"parameters", {{"scene.size.0", 2048}, {"scene.size.1", 2048}}}});
    std::future<Reply> reply = std::async(std::launch::async, [&] { return inspector.render(ask); });
    while (parse(inspector.progress())["total"] != 2048) // rows
        std::this_thread::sleep_for(1ms);
    inspector.cancel();
    EXPECT_EQ(reply.get().status, 409);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(inspector.render(question("large")).status, 200);
    EXPECT_LT(std::chrono::steady_clock::now() - start, 20s);
}

TEST_F(InspectorTest, aChangedSetIsSavedAsACaseThatCanBeAskedFor)
{
    const std::string ask =
        Json{{"case", "floor"}, {"parameters", {{"camera.fov", 45}, {"scene.size.0", 24}}}, {"name", "narrow"}}.dump();
    const Reply reply = inspector_->save(ask);
    ASSERT_EQ(reply.status, 200) << reply.body;
    const Json json = parse(reply);
    EXPECT_EQ(json["file"], (folder_ / "narrow.toml").generic_string());
    EXPECT_EQ(json["case"], "narrow");
    EXPECT_EQ(json["item"]["width"], 24);
    const Case saved = readCaseFile(folder_ / "narrow.toml").at(0);
    EXPECT_EQ(saved.camera.fovYDegrees, 45);
    const auto planes = [&](const std::string& body) {
        const Json answer = parse(inspector_->render(body));
        return parsePlanes(inspector_->data(answer["planes"]["cpu64"])).dump();
    };
    EXPECT_EQ(planes(question("narrow")),
              planes(question("floor", {{"parameters", {{"camera.fov", 45}, {"scene.size.0", 24}}}})));
    EXPECT_EQ(errorOf(inspector_->save(ask), 409),
              (folder_ / "narrow.toml").string() + ": is there already; another name is allowed");
    EXPECT_EQ(inspector_->save(Json{{"case", "floor"}, {"name", "../narrow"}}.dump()).status, 422);
}

TEST_F(InspectorTest, thePageHasTheCasesAndTheToken)
{
    const Reply page = inspector_->page();
    EXPECT_EQ(page.type, "text/html; charset=utf-8");
    const std::string opening = "<script type=\"application/json\" id=\"data-index\">";
    const size_t begin = page.body.find(opening) + opening.size();
    const Json index = Json::parse(page.body.substr(begin, page.body.find("</script>", begin) - begin));
    EXPECT_EQ(index["live"], true);
    EXPECT_EQ(index["token"], kToken);
    EXPECT_EQ(index["cases"].size(), 3u);
    EXPECT_EQ(index["cases"][0]["name"], "crash");
    EXPECT_TRUE(index["cases"][0]["results"].empty());
    EXPECT_EQ(index["backends"].size(), 2u);
    EXPECT_EQ(index["schema"], "crossray-report/1");
}
