// Every way in which a case file can be wrong, with the whole line that its author reads.
#include "tests/unit/case/case_files.h"

#include <fmt/format.h>

using namespace crossray;

using BadInput = CaseFiles;

namespace {

// A case whose only expectation is given from line 5 on: its [[expect]] is line 5, the first key line 6.
std::string expecting(const std::string& keys)
{
    return "schema = 1\nname = \"a\"\nsummary = \"It holds.\"\nscene = {}\n[[expect]]\n" + keys;
}

} // namespace

TEST_F(BadInput, unknownKeysAreAnsweredWithTheNearestName)
{
    EXPECT_EQ(refusal(withScene("[material]\niro = 1.5\n")),
              "a.toml:11:1: unknown key \"iro\" in [material]; did you "
              "mean \"ior\"? Allowed: refraction_model, ior, thickness, "
              "thickness_multiplier, thickness_map, roughness, transmittance_color, absorption_distance, fresnel");
    EXPECT_EQ(refusal(withScene("[material]\nzzzz = 1.5\n")),
              "a.toml:11:1: unknown key \"zzzz\" in [material]; allowed: refraction_model, ior, thickness, "
              "thickness_multiplier, thickness_map, roughness, transmittance_color, absorption_distance, fresnel");
    EXPECT_EQ(
        refusal(withScene("sky = { zenit = [0, 0, 0] }\n")),
        "a.toml:10:9: unknown key \"zenit\" in [scene.sky]; did you mean \"zenith\"? Allowed: zenith, horizon, nadir");
    EXPECT_EQ(refusal(withScene("[materials]\n")),
              "a.toml:10:2: unknown key \"materials\" at the top level; did you "
              "mean \"material\"? Allowed: schema, name, summary, "
              "tags, use, trace, outputs, backends, timeout, must_fail, bench, needs, budget, camera, "
              "scene, gbuffer, material, projection, history, hierarchy, probe, "
              "probe_profile, profile, dominant_direction, sky, expect, "
              "expand, known_failure");
}

TEST_F(BadInput, wrongTypesSayWhatIsAllowed)
{
    EXPECT_EQ(refusal(withScene("[material]\nior = \"high\"\n")),
              "a.toml:11:7: \"ior\" is a string; a number is allowed: above 0, at most 10");
    EXPECT_EQ(refusal(withScene("[projection]\nmin_level = 1.5\n")),
              "a.toml:11:13: \"min_level\" is a number; an integer is allowed: 0 to 14");
    EXPECT_EQ(refusal(withScene("size = 64\n")),
              "a.toml:10:8: \"size\" is an integer; a list of 2 integers is allowed: 1 to 16384");
    EXPECT_EQ(refusal(withScene("size = [64]\n")),
              "a.toml:10:8: \"size\" has 1 value; a list of 2 integers is allowed");
    EXPECT_EQ(refusal(withScene("primitives = [3]\n")),
              "a.toml:10:15: \"primitives\" is an integer; a list of tables is allowed");
    EXPECT_EQ(refusal(withScene("[camera]\neye = [0, \"x\", 0]\n")),
              "a.toml:11:11: \"eye\" is a string; a list of 3 numbers is allowed");
    EXPECT_EQ(refusal(complete("", "must_fail = 1\nscene = {}")),
              "a.toml:4:13: \"must_fail\" is an integer; a boolean is allowed");
    EXPECT_EQ(refusal(complete("", "tags = \"x\"\nscene = {}")),
              "a.toml:4:8: \"tags\" is a string; a list of strings is allowed: words of a-z, 0-9, _ and -");
    EXPECT_EQ(refusal(complete("", "camera = 3\nscene = {}")),
              "a.toml:4:10: \"camera\" is an integer; a table is allowed");
}

TEST_F(BadInput, numbersOutOfRangeSayTheRange)
{
    EXPECT_EQ(refusal(withScene("[material]\nior = 0\n")), "a.toml:11:7: \"ior\" is 0; above 0, at most 10 is allowed");
    EXPECT_EQ(refusal(withScene("size = [0, 0]\n")), "a.toml:10:9: \"size\" is 0; 1 to 16384 is allowed");
    EXPECT_EQ(refusal(withScene("size = [40000, 40000]\n")), "a.toml:10:9: \"size\" is 40000; 1 to 16384 is allowed");
    EXPECT_EQ(refusal(withScene("[camera]\nfov = 180\n")),
              "a.toml:11:7: \"fov\" is 180; above 0, below 180 is allowed");
    EXPECT_EQ(refusal(withScene("[projection]\nmin_level = 5\nmax_level = 4\n")),
              "a.toml:11:13: \"min_level\" is 5; at most \"max_level\", which is 4, is allowed");
    EXPECT_EQ(refusal(withScene("[camera]\nnear = 2\nfar = 1\n")),
              "a.toml:12:7: \"far\" is 1; beyond \"near\", which is 2, is allowed");
}

TEST_F(BadInput, infAndNanAreRefusedWhereTheyStand)
{
    EXPECT_EQ(refusal(withScene("[camera]\neye = [0, nan, 0]\n")),
              "a.toml:11:11: nan is not allowed; a finite number is");
    EXPECT_EQ(refusal(withScene("[camera]\nfar = inf\n")), "a.toml:11:7: inf is not allowed; a finite number is");
    EXPECT_EQ(refusal(withScene("[camera]\nfar = 12:00:00\n")),
              "a.toml:11:7: a time of day is not allowed; a date alone is, as YYYY-MM-DD");
}

TEST_F(BadInput, brokenTomlHasAPosition)
{
    EXPECT_OPENS(refusal("schema = = 1\n"), "a.toml:1:10: not valid TOML: Er");
    EXPECT_OPENS(refusal("schema = 1\nname = \"a\"\nname = \"b\"\n"), "a.toml:3:8: not valid TOML:");
}

TEST_F(BadInput, filesThatAreNone)
{
    EXPECT_EQ(messageOf([&] { readCaseFile(folder_ / "none.toml"); }), "none.toml: the file does not exist");
    EXPECT_EQ(messageOf([&] { readCaseFile(folder_); }), "FOLDER: is not a file; a case is a TOML file");
    EXPECT_EQ(messageOf([&] { readCaseFile(write("big.toml", std::string(2 << 20, '#'))); }),
              "big.toml: has 2097152 bytes; at most 1048576 are allowed");
}

TEST_F(BadInput, whatIsRequiredIsNamed)
{
    EXPECT_EQ(refusal(""), "a.toml:1:1: \"schema\" is missing at the top level; an integer is required: 1");
    EXPECT_EQ(refusal("schema = 2\n"), "a.toml:1:10: \"schema\" is 2; 1 is allowed");
    EXPECT_EQ(refusal("schema = 1\nname = \"a\"\nsummary = \"\"\n"),
              "a.toml:3:11: \"summary\" is empty; some text is allowed");
    EXPECT_EQ(refusal("schema = 1\nname = \"a\"\nsummary = \"b\"\nscene = {}\n"),
              "a.toml:1:1: \"expect\" is missing at the top level; a list of tables is required");
    EXPECT_EQ(refusal("schema = 1\nname = \"a\"\nsummary = \"b\"\nscene = {}\nexpect = []\n"),
              "a.toml:5:10: \"expect\" is empty; one expectation or more is required");
    EXPECT_EQ(refusal(complete("")), "a.toml:1:1: [scene] or [gbuffer] is missing; exactly one of them is required");
}

TEST_F(BadInput, namesAndTagsHaveAnAlphabet)
{
    const std::string rest = "summary = \"b\"\nscene = {}\nexpect = [{ output = \"HitSuccess\", truth = \"hit\" }]\n";
    for (const char* name : {"A", "a b", "/a", "a/", "a//b", "a-b", "\xc3\xa9"}) {
        EXPECT_EQ(
            refusal(fmt::format("schema = 1\nname = \"{}\"\n", name) + rest),
            fmt::format("a.toml:2:8: \"name\" is \"{}\"; words of a-z, 0-9 and _, joined by /, are allowed", name));
    }
    EXPECT_EQ(readOne("schema = 1\nname = \"a_1/b2/c\"\n" + rest).name, "a_1/b2/c");
    EXPECT_EQ(refusal("schema = 1\nname = \"a\"\ntags = [\"x\", \"X\"]\n" + rest),
              "a.toml:3:14: \"X\" is no tag; a word of a-z, 0-9, _ and - is allowed");
    EXPECT_EQ(refusal("schema = 1\nname = \"a\"\ntags = [\"x\", \"x\"]\n" + rest),
              "a.toml:3:14: \"x\" is twice in \"tags\"; once is allowed");
}

TEST_F(BadInput, aNameOfNoChoiceIsAnsweredWithTheChoices)
{
    EXPECT_EQ(refusal(withScene("[projection]\nmodel = \"hzi\"\n")),
              "a.toml:11:9: \"hzi\" is no name for \"model\"; did you mean \"hiz\"? Allowed: none, proxy_infinite, "
              "proxy_box, "
              "proxy_sphere, hiz, linear, patches, proxy_probe, own");
    EXPECT_OPENS(refusal(expecting("output = \"HitDepht\"\n")),
                 "a.toml:6:10: \"HitDepht\" is no name for \"output\"; did you mean \"HitDepth\"?");
    EXPECT_EQ(refusal(complete("", "scene = {}\nbackends = [\"lavapip\"]")),
              "a.toml:5:13: \"lavapip\" is no name for \"backends\"; did you mean \"lavapipe\"? Allowed: lavapipe, "
              "swiftshader, "
              "osmesa, softpipe, egl, cpu32, cpu64, vulkan:NAME");
    EXPECT_EQ(readOne(complete("", "scene = {}\nbackends = [\"vulkan:radv\"]")).backends,
              std::vector<std::string>{"vulkan:radv"});
}

TEST_F(BadInput, anExpectationHasExactlyOneSource)
{
    EXPECT_EQ(refusal(expecting("output = \"HitDepth\"\nanalytic = \"x\"\ntruth = \"y\"\n")),
              "a.toml:8:9: two sources, \"analytic\" and \"truth\"; exactly one of analytic, truth, constant, "
              "golden, agree, at_most and finite is allowed");
    EXPECT_EQ(refusal(expecting("output = \"HitDepth\"\n")), "a.toml:5:1: no source; exactly one of analytic, truth, "
                                                             "constant, golden, agree, at_most and finite is required");
    EXPECT_EQ(refusal(expecting("output = \"HitSuccess\"\nagree = [\"osmesa\"]\n")),
              "a.toml:7:9: \"agree\" has 1 name; two or more are allowed");
}

TEST_F(BadInput, aBoundIsOfNumbersAndHasNoTolerance)
{
    EXPECT_EQ(refusal(expecting("output = \"HitSuccess\"\nat_most = 1\n")),
              "a.toml:7:11: \"at_most\" of HitSuccess is not allowed; depths, colours, scalars and counts have one");
    EXPECT_EQ(refusal(expecting("output = \"HitDepth\"\nat_most = 1\ntolerance = { absolute = 1 }\n")),
              "a.toml:8:13: a tolerance beside \"at_most\" is not allowed; the bound is one");
    EXPECT_EQ(refusal(expecting("finite = false\n")), "a.toml:6:10: \"finite\" is false; true is allowed");
    EXPECT_EQ(refusal(expecting("analytic = \"x\"\n")),
              "a.toml:5:1: \"output\" is missing in [expect]; \"finite\" alone does without");
}

TEST_F(BadInput, aToleranceFitsItsOutput)
{
    EXPECT_EQ(refusal(expecting("output = \"HitDepth\"\ntruth = \"y\"\ntolerance = { degrees = 1 }\n")),
              "a.toml:8:15: \"degrees\" is no bound of HitDepth; allowed: relative, absolute, ulps, floor, double, "
              "outliers and worst");
    EXPECT_EQ(refusal(expecting("output = \"RayDirWS\"\ntruth = \"y\"\ntolerance = { relative = 1 }\n")),
              "a.toml:8:15: \"relative\" is no bound of RayDirWS; allowed: degrees, outliers and worst");
    EXPECT_EQ(refusal(expecting("output = \"HitSuccess\"\ntruth = \"y\"\ntolerance = { absolute = 1 }\n")),
              "a.toml:8:15: \"absolute\" is no bound of HitSuccess; allowed: outliers and worst");
    EXPECT_EQ(refusal(expecting("output = \"HitDepth\"\ntruth = \"y\"\ntolerance = { relative = -1e-3 }\n")),
              "a.toml:8:26: \"relative\" is -0.001; at least 0 is allowed");
    EXPECT_EQ(refusal(expecting("output = \"HitDepth\"\ntruth = \"y\"\ntolerance = { floor = 1 }\n")),
              "a.toml:8:13: the tolerance sets no bound of HitDepth; one of relative, absolute and ulps is required");
    EXPECT_EQ(refusal(expecting("output = \"HitDepth\"\ntruth = \"y\"\n")),
              "a.toml:5:1: \"tolerance\" is missing; HitDepth requires one that sets relative, absolute and ulps");
    EXPECT_EQ(refusal(expecting("output = \"RayDirWS\"\ntruth = \"y\"\ntolerance = { degrees = 1, outliers = 0.1 }\n")),
              "a.toml:8:39: \"outliers\" never stands alone; \"worst\" is required beside it");
    EXPECT_EQ(refusal(expecting("output = \"RayDirWS\"\ntruth = \"y\"\ntolerance = { degrees = 1, worst = 2 }\n")),
              "a.toml:8:36: \"worst\" bounds outliers; \"outliers\" is required beside it");
}

TEST_F(BadInput, aBudgetIsOfHitSuccessAgainstTheTruth)
{
    EXPECT_EQ(refusal(expecting("output = \"HitDepth\"\ntruth = \"y\"\nbudget = { recall = 0.9 }\n")),
              "a.toml:8:10: a budget of HitDepth is not allowed; HitSuccess alone has one");
    EXPECT_EQ(refusal(expecting("output = \"HitSuccess\"\nconstant = \"hit\"\nbudget = { recall = 0.9 }\n")),
              "a.toml:8:10: a budget needs truth as its source, not constant");
    EXPECT_EQ(refusal(expecting("output = \"HitSuccess\"\ntruth = \"y\"\nbudget = {}\n")),
              "a.toml:8:10: the budget bounds nothing; one of recall, precision and false_hits is required");
    EXPECT_EQ(refusal(expecting("output = \"HitSuccess\"\ntruth = \"y\"\nbudget = { recall = 2 }\n")),
              "a.toml:8:21: \"recall\" is 2; 0 to 1 is allowed");
    EXPECT_EQ(refusal(expecting("output = \"HitSuccess\"\ntruth = \"y\"\nbudget = { recall = 1 }\ntolerance = {}\n")),
              "a.toml:9:13: a tolerance beside a budget is not allowed; the budget judges by shares");
}

TEST_F(BadInput, aConstantFitsItsOutput)
{
    EXPECT_EQ(
        refusal(expecting("output = \"HitSuccess\"\nconstant = 1\n")),
        "a.toml:7:12: \"constant\" of HitSuccess is a class; allowed: \"no_raycast\", \"hit\", \"miss\", \"unknown\"");
    EXPECT_EQ(refusal(expecting("output = \"Color\"\nconstant = [1, 2]\n")),
              "a.toml:7:12: \"constant\" has 2 values; Color has 3 channels");
    EXPECT_EQ(refusal(expecting("output = \"HitDepth\"\nconstant = \"hit\"\n")),
              "a.toml:7:12: \"constant\" is a name; HitDepth has 1 channel");
    EXPECT_EQ(refusal(expecting("output = \"RayDirWS\"\nconstant = [0, 0, 2]\n")),
              "a.toml:7:12: \"constant\" has length 2; a direction has length 1");
    EXPECT_EQ(refusal(expecting("output = \"IterationCount\"\nconstant = 1.5\n")),
              "a.toml:7:12: \"constant\" of IterationCount is a whole number");
}

TEST_F(BadInput, pathsStayInTheCasesFolder)
{
    const auto golden = [&](const std::string& path) {
        return refusal(expecting("output = \"HitSuccess\"\ngolden = \"" + path + "\"\n"));
    };
    write("outside.exr", "");
    EXPECT_EQ(golden("../outside.exr"),
              "a.toml:7:10: \"golden\" is \"../outside.exr\", which leaves the case's folder; a relative "
              "path inside FOLDER is allowed");
    EXPECT_EQ(golden("/etc/passwd"),
              "a.toml:7:10: \"golden\" is \"/etc/passwd\", which leaves the case's folder; a relative path "
              "inside FOLDER is allowed");
    std::filesystem::create_symlink("/etc", folder_ / "link");
    EXPECT_EQ(golden("link/passwd"),
              "a.toml:7:10: \"golden\" is \"link/passwd\", which leaves the case's folder; a relative path "
              "inside FOLDER is allowed");
    EXPECT_EQ(golden("sub/../x.exr"), "nothing was thrown"); // it may be absent: that is the verdict missing-golden
}

TEST_F(BadInput, aRecordedGBufferNamesFilesThatExist)
{
    const std::string gbuffer =
        "schema = 1\nname = \"a\"\nsummary = \"b\"\nexpect = [{ output = \"HitSuccess\", truth = \"hit\" }]\n"
        "[gbuffer]\nobject = 1\ncamera = \"c.json\"\nfile = \"g.exr\"\n";
    EXPECT_EQ(refusal(gbuffer), "a.toml:8:8: \"file\" is \"g.exr\", and there is no such file in FOLDER");
    write("g.exr", "");
    EXPECT_EQ(refusal(gbuffer), "a.toml:7:10: \"camera\" is \"c.json\", and there is no such file in FOLDER");
    write("c.json", "{}");
    EXPECT_EQ(refusal(gbuffer + "[gbuffer.channels]\nnormal_ws = [\"N.X\"]\n"),
              "a.toml:10:13: \"normal_ws\" has 1 name; 3 are allowed");
    EXPECT_EQ(refusal(gbuffer + "[scene]\n"),
              "a.toml:5:1: [scene] and [gbuffer] are both given; exactly one of them is allowed");
}

TEST_F(BadInput, camerasThatSeeNothing)
{
    EXPECT_EQ(refusal(withScene("[camera]\neye = [1, 2, 3]\ntarget = [1, 2, 3]\n")),
              "a.toml:12:10: \"target\" is the eye; any other point is allowed");
    EXPECT_EQ(refusal(withScene("[camera]\nup = [0, 0, 2]\n")),
              "a.toml:11:6: \"up\" is along the view or has length 0; any other direction is allowed");
    EXPECT_EQ(refusal(withScene("[camera]\nup = [0, 0, 0]\n")),
              "a.toml:11:6: \"up\" is along the view or has length 0; any other direction is allowed");
}

TEST_F(BadInput, anOrthographicDepthIsFinite)
{
    EXPECT_EQ(
        refusal(withScene("[camera]\nprojection = \"orthographic\"\ndepth = \"infinite_reversed\"\n")),
        "a.toml:12:9: \"depth\" is \"infinite_reversed\" in an orthographic view, whose depth cannot be infinite; "
        "reversed and standard are allowed");
}

TEST_F(BadInput, primitivesHaveWhatTheirShapeNeeds)
{
    const auto primitive = [&](const std::string& keys) {
        return refusal(withScene("primitives = [{ shape = " + keys + " }]\n"));
    };
    EXPECT_EQ(primitive("\"sphere\""), "a.toml:10:25: \"radius\" is missing; a sphere requires it");
    EXPECT_EQ(primitive("\"box\""), "a.toml:10:25: \"half_extents\" is missing; a box requires it");
    EXPECT_EQ(primitive("\"sphere\", radius = 0"), "a.toml:10:44: \"radius\" is 0; above 0 is allowed");
    EXPECT_EQ(primitive("\"plane\", radius = 1"), "a.toml:10:43: \"radius\" is not allowed for a plane");
    EXPECT_EQ(primitive("\"box\", half_extents = [1, 2]"), "a.toml:10:47: \"half_extents\" has 2 values; a box has 3");
    EXPECT_EQ(primitive("\"box\", normal = [0, 1, 0], half_extents = [1, 1, 1]"),
              "a.toml:10:41: \"normal\" is not allowed for a box");
    EXPECT_EQ(primitive("\"plane\", normal = [0, 0, 0]"),
              "a.toml:10:43: \"normal\" has length 0; any other length is allowed");
    EXPECT_EQ(primitive("\"plane\", normal = [0, 1, 0], rotation = [0, 0, 0]"),
              "a.toml:10:43: \"normal\" and \"rotation\" are both given; one of them is allowed");
    EXPECT_EQ(primitive("\"plane\", rotation = { axis = [0, 0, 0], degrees = 3 }"),
              "a.toml:10:54: \"axis\" has length 0; any other length is allowed");
    EXPECT_EQ(primitive("\"plane\", rotation = { axis = [0, 0, 1] }"),
              "a.toml:10:45: \"degrees\" is missing in [rotation]; a number is required");
    EXPECT_EQ(primitive("\"plane\", color = [-1, 0, 0]"), "a.toml:10:43: \"color\" is -1; at least 0 is allowed");
}

TEST_F(BadInput, projectionsHaveTheirVolume)
{
    EXPECT_EQ(refusal(withScene("[projection]\nmodel = \"proxy_box\"\n")),
              "a.toml:11:9: \"half_extents\" is missing in [projection.proxy]; proxy_box requires it");
    EXPECT_EQ(refusal(withScene("[projection]\nmodel = \"proxy_sphere\"\n")),
              "a.toml:11:9: \"radius\" is missing in [projection.proxy]; proxy_sphere requires it");
}

TEST_F(BadInput, traceAndRefractionModelAgree)
{
    EXPECT_EQ(refusal(complete("[material]\nrefraction_model = \"box\"\n", "trace = \"reflection\"\nscene = {}")),
              "a.toml:4:9: \"trace\" is \"reflection\" and refraction_model is \"box\"; \"refraction\" is allowed, or "
              "refraction_model = \"none\"");
}

TEST_F(BadInput, aKnownFailureHasIssueDateAndReason)
{
    const auto failure = [&](const std::string& keys) { return refusal(withScene("[[known_failure]]\n" + keys)); };
    EXPECT_EQ(failure("until = \"2031-01-01\"\nreason = \"x\"\n"),
              "a.toml:10:1: \"issue\" is missing in [known_failure]; a string is required: not empty");
    for (const char* date :
         {"2031-13-01", "2031-02-29", "2031-1-1", "tomorrow", "2031-00-10", "2031-04-31", "20310-4-01"}) {
        EXPECT_EQ(
            failure(fmt::format("issue = \"#1\"\nreason = \"x\"\nuntil = \"{}\"\n", date)),
            fmt::format("a.toml:13:9: \"until\" is \"{}\"; a day of the calendar as YYYY-MM-DD is allowed", date));
    }
    EXPECT_EQ(failure("issue = \"#1\"\nreason = \"x\"\nuntil = 2032-02-29\n"), "nothing was thrown");
    EXPECT_EQ(refusal(complete("[[known_failure]]\nissue = \"#1\"\nreason = \"x\"\nuntil = 2032-02-29\n",
                               "must_fail = true\nscene = {}")),
              "a.toml:10:1: a known failure of a must_fail case is not allowed; one of them is");
}

TEST_F(BadInput, whatMayBeExcusedIsBounded)
{
    const std::string weight = "output = \"HitWeight\"\nconstant = 1\ntolerance = { absolute = 0.1 }\n";
    EXPECT_EQ(refusal(expecting(weight + "undecidable = 0\n")),
              "a.toml:9:15: \"undecidable\" is 0; above 0, at most 0.5 is allowed");
    EXPECT_EQ(refusal(expecting(weight + "undecidable = 0.6\n")),
              "a.toml:9:15: \"undecidable\" is 0.6; above 0, at most 0.5 is allowed");
    EXPECT_EQ(refusal(expecting(weight + "undecidable_above = 64\n")),
              "a.toml:9:21: \"undecidable_above\" excuses nothing alone; \"undecidable\" is required beside it");
    EXPECT_EQ(refusal(expecting(weight + "undecidable = 0.1\nundecidable_above = 1\n")),
              "a.toml:10:21: \"undecidable_above\" is 1; at least 16 is allowed");
    EXPECT_EQ(
        refusal(expecting("output = \"HitSuccess\"\ntruth = \"hit\"\nbudget = { recall = 0.5 }\nundecidable = 0.1\n")),
        "a.toml:9:15: \"undecidable\" beside a budget is not allowed; the budget judges by shares");
}

TEST_F(BadInput, whatIsQuotedBreaksNoLine)
{
    EXPECT_EQ(refusal(withScene("primitives = [{ shape = \"pl\\n\\u007fe\" }]\n")),
              "a.toml:10:25: \"pl  e\" is no name for \"shape\"; did you mean \"plane\"? Allowed: plane, sphere, box, "
              "lens, torus");
}
