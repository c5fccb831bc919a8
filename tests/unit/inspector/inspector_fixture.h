// An inspector on a folder of small cases, with real workers and one that misbehaves on demand.
#pragma once

#include "harness/base/temporary_folder.h"
#include "harness/base/text.h"
#include "harness/inspector/inspector.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace crossray {

class InspectorFixture : public testing::Test {
  protected:
    using Json = nlohmann::json;

    void SetUp() override
    {
        // The worker for tests crashes and hangs for jobs of these names.
        for (const char* name : {"crash", "hang"})
            writeCase(name, "timeout = 60.0\n", "");
        writeCase(
            "floor", "",
            "[[expect]]\noutput = \"RayDirWS\"\nanalytic = \"reflection_direction\"\ntolerance = { degrees = 1e-3 }\n");
        setup_.live = {std::filesystem::path(CROSSRAY_SOURCE_DIR) / "shaders",
                       "inspector-test-cache",
                       CROSSRAY_BINARY_DIR "/worker_program",
                       {"cpu64", "cpu32", "test"}};
        setup_.cases = folder_;
        setup_.token = kToken;
        for (const std::filesystem::path& file : findCaseFiles(folder_)) {
            for (Case& testCase : readCaseFile(file))
                setup_.selected.push_back(std::move(testCase));
        }
        inspector_ = std::make_unique<Inspector>(setup_);
    }

    // A mirror under the camera, traced by HiZ.
    void writeCase(const std::string& name, const std::string& top, const std::string& more)
    {
        std::ofstream(folder_ / (name + ".toml"))
            << "schema = 1\nname = \"" << name << "\"\nsummary = \"It holds.\"\noutputs = [\"HitSuccess\"]\n"
            << top
            << "[scene]\nsize = [16, 12]\nprimitives = [\n"
               "    { shape = \"plane\", center = [0, -1, 0], normal = [0, 1, 0], half_extents = [9, 9], material = "
               "\"mirror\" },\n"
               "    { shape = \"box\", center = [0, 0, -4], half_extents = [1, 1, 0.5] },\n]\n"
               "[camera]\neye = [0, 0.5, 1]\ntarget = [0, -0.5, -3]\n"
               "[projection]\nmodel = \"hiz\"\nmin_level = 0\n"
            << (more.empty() ? "[[expect]]\noutput = \"HitSuccess\"\nconstant = \"hit\"\n" : more);
    }

    static Json parse(const Reply& reply) { return Json::parse(reply.body); }
    // The head of a piece of planes, each with its floats' bits as "data".
    static Json parsePlanes(const Reply& reply)
    {
        EXPECT_EQ(reply.status, 200) << reply.body;
        EXPECT_EQ(reply.type, "application/octet-stream");
        const auto wordAt = [&](size_t at) {
            uint32_t word = 0;
            if (at + sizeof(word) <= reply.body.size()) std::memcpy(&word, reply.body.data() + at, sizeof(word));
            return word;
        };
        size_t at = sizeof(uint32_t) + wordAt(0);
        Json json = Json::parse(reply.body.substr(sizeof(uint32_t), wordAt(0)));
        for (Json& plane : json["planes"]) {
            const size_t count =
                json["width"].get<size_t>() * json["height"].get<size_t>() * plane["channels"].get<size_t>();
            for (size_t i = 0; i < count; ++i, at += sizeof(uint32_t))
                plane["data"].push_back(wordAt(at));
        }
        EXPECT_EQ(at, reply.body.size());
        return json;
    }
    static std::string question(const std::string& testCase, const Json& more = Json::object())
    {
        Json json{{"case", testCase}, {"parameters", Json::object()}, {"backends", {"cpu64"}}};
        json.update(more);
        return json.dump();
    }
    std::string errorOf(const Reply& reply, int status) const
    {
        EXPECT_EQ(reply.status, status) << reply.body;
        const Json json = parse(reply);
        return json.contains("error") ? json["error"].get<std::string>() : "no error";
    }

    static constexpr const char* kToken = "0123456789abcdef0123456789abcdef";
    TemporaryFolder temporary_{"inspector"};
    const std::filesystem::path folder_ = temporary_.path();
    InspectorSetup setup_;
    std::unique_ptr<Inspector> inspector_;
};

} // namespace crossray
