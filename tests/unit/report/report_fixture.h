// A run of three cases on two backends, and the planes that it kept.
#pragma once

#include "harness/report/report.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>

namespace crossray {

struct ReportFixture {
    RunResult run;
    std::map<std::string, std::vector<Plane>> planes; // by file

    ReportFixture()
    {
        run.version = "0.1.0";
        run.started = "2026-01-31T12:00:00Z";
        for (const char* name : {"cpu64", "osmesa"})
            run.backends[name].fingerprint.device = name;
        addFailure("hiz/far_depth");
        addPass("probe/weight");
        CaseResult& crashed = addCase("refraction/crashes");
        crashed.backends.push_back(makeResult("osmesa", Verdict::kCrash));
        crashed.backends[0].reason = "killed by signal 11";
    }

    CaseResult& addCase(const std::string& name)
    {
        CaseResult testCase;
        testCase.name = name;
        testCase.summary = "A claim.";
        testCase.tags = {"tag"};
        testCase.position = {"cases/" + name + ".toml", 3, 1};
        testCase.width = 4;
        testCase.height = 2;
        run.cases.push_back(testCase);
        return run.cases.back();
    }

    static BackendResult makeResult(const std::string& backend, Verdict verdict)
    {
        BackendResult result;
        result.backend = backend;
        result.verdict = verdict;
        return result;
    }

    static ExpectationResult makeExpectation(bool passed)
    {
        ExpectationResult expectation;
        expectation.output = "HitDepth";
        expectation.source = "constant";
        expectation.position = {"cases/a.toml", 17, 1};
        expectation.tolerance = "0.001 relative";
        expectation.judged = true;
        expectation.comparison.passed = passed;
        expectation.comparison.unit = "relative";
        expectation.comparison.compared = 7;
        expectation.comparison.failed = passed ? 0 : 2;
        expectation.comparison.worst = PixelDifference{1, 1, {2.5}, {3.0}, 0.2};
        if (!passed) expectation.comparison.census["beyond tolerance"] = 2;
        expectation.comparison.reason = passed ? "" : "worst 0.2 relative at (1, 1)";
        return expectation;
    }

    void addPass(const std::string& name)
    {
        CaseResult& testCase = addCase(name);
        for (const char* backend : {"cpu64", "osmesa"}) {
            testCase.backends.push_back(makeResult(backend, Verdict::kPass));
            testCase.backends.back().expectations.push_back(makeExpectation(true));
        }
    }

    // cpu64 answers 2.5 everywhere; osmesa 3 at (1, 1), a NaN at (2, 0), and something at (3, 1), which is not
    // compared.
    void addFailure(const std::string& name)
    {
        CaseResult& testCase = addCase(name);
        testCase.expectedFile = "planes/" + name + "/expected.exr";
        Plane expected("HitDepth@0", 4, 2, 1, 2.5), mask("mask@0", 4, 2, 1, 1.0);
        mask.at(3, 1) = 0;
        planes[testCase.expectedFile] = {expected, mask};
        for (const char* backend : {"cpu64", "osmesa"}) {
            const bool fails = std::string(backend) == "osmesa";
            BackendResult result = makeResult(backend, fails ? Verdict::kFail : Verdict::kPass);
            result.planesFile = "planes/" + name + "/" + backend + ".exr";
            result.expectations.push_back(makeExpectation(!fails));
            if (fails) result.reason = "HitDepth: worst 0.2 relative at (1, 1)";
            Plane depth("HitDepth", 4, 2, 1, 2.5), direction("RayDirWS", 4, 2, 3, 0.1);
            if (fails) {
                depth.at(1, 1) = 3.0;
                depth.at(2, 0) = std::numeric_limits<double>::quiet_NaN();
                depth.at(3, 1) = 1.0;
            }
            planes[result.planesFile] = {depth, direction};
            testCase.backends.push_back(result);
        }
    }

    std::map<std::string, std::string> make(const ReportOptions& options, ReportSummary* summary = nullptr) const
    {
        std::map<std::string, std::string> files;
        const auto read = [&](const std::string& file) { return planes.at(file); };
        const ReportSummary made =
            makeReport(run, options, read, [&](const std::string& file, std::string_view content) {
                EXPECT_TRUE(files.emplace(file, content).second) << file << " is written twice";
            });
        if (summary != nullptr) *summary = made;
        return files;
    }
};

} // namespace crossray
