#include "harness/bench/bench_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace crossray {

namespace {

using Json = nlohmann::ordered_json;
constexpr const char* kSchema = "crossray-bench/1";

Json toJson(const BenchPoint& point)
{
    return {{"method", point.method},
            {"kind", point.kind},
            {"errors", point.errors},
            {"counters", point.counters},
            {"milliseconds",
             {{"median", point.time.median},
              {"fastest", point.time.fastest},
              {"slowest", point.time.slowest},
              {"ratio", point.time.ratio}}}};
}

BenchPoint readPoint(const Json& json)
{
    BenchPoint point;
    point.method = json.at("method").get<std::string>();
    point.kind = json.at("kind").get<std::string>();
    point.errors = json.at("errors").get<std::map<std::string, double>>();
    point.counters = json.at("counters").get<std::map<std::string, double>>();
    const Json& time = json.at("milliseconds");
    point.time = {time.at("median").get<double>(), time.at("fastest").get<double>(), time.at("slowest").get<double>(),
                  time.at("ratio").get<double>()};
    return point;
}

} // namespace

std::string formatBenchJson(const BenchResult& result)
{
    const Fingerprint& print = result.fingerprint;
    Json scenes = Json::array();
    for (const BenchScene& scene : result.scenes) {
        Json points = Json::array();
        for (const BenchPoint& point : scene.points)
            points.push_back(toJson(point));
        scenes.push_back({{"case", scene.name},
                          {"effect", scene.effect},
                          {"parameter", scene.parameter},
                          {"size", {scene.width, scene.height}},
                          {"rays", scene.rays},
                          {"unknowable", scene.unknowable},
                          {"oracleWrong", scene.oracleWrong},
                          {"trueFlips", scene.trueFlips ? Json(*scene.trueFlips) : Json(nullptr)},
                          {"baselineMilliseconds", scene.baselineMs},
                          {"methods", points}});
    }
    const Json json{{"schema", kSchema},
                    {"command", result.command},
                    {"fingerprint",
                     {{"backend", print.backend},
                      {"api", print.api},
                      {"device", print.device},
                      {"driver", print.driver},
                      {"llvm", print.llvm},
                      {"cpu", print.cpu}}},
                    {"scenes", scenes}};
    return json.dump(2) + "\n";
}

BenchResult readBenchJson(const std::string& file)
{
    std::ifstream stream(file);
    if (!stream) throw InputError(fmt::format("{}: cannot be read", file));
    try {
        const Json json = Json::parse(stream);
        if (json.at("schema") != kSchema) throw InputError(fmt::format("{}: its schema is not {}", file, kSchema));
        BenchResult result;
        result.command = json.at("command").get<std::string>();
        const Json& print = json.at("fingerprint");
        result.fingerprint = {print.at("backend").get<std::string>(), print.at("api").get<std::string>(),
                              print.at("device").get<std::string>(),  print.at("driver").get<std::string>(),
                              print.at("llvm").get<std::string>(),    print.at("cpu").get<std::string>()};
        for (const Json& scene : json.at("scenes")) {
            BenchScene read;
            read.name = scene.at("case").get<std::string>();
            read.effect = scene.at("effect").get<std::string>();
            read.baselineMs = scene.at("baselineMilliseconds").get<double>();
            for (const Json& point : scene.at("methods"))
                read.points.push_back(readPoint(point));
            result.scenes.push_back(std::move(read));
        }
        return result;
    } catch (const nlohmann::json::exception& error) {
        throw InputError(fmt::format("{}: no figures of a bench: {}", file, error.what()));
    }
}

std::string formatBenchCsv(const BenchResult& result)
{
    std::string text = "case,method,kind,figure,value\n";
    for (const BenchScene& scene : result.scenes) {
        for (const BenchPoint& point : scene.points) {
            const auto add = [&](const std::string& figure, double value) {
                text += fmt::format("\"{}\",\"{}\",{},{},{}\n", scene.name, point.method, point.kind, figure, value);
            };
            for (const auto& [name, value] : point.errors)
                add(name, value);
            for (const auto& [name, value] : point.counters)
                add(name, value);
            add("MillisecondsMedian", point.time.median);
            add("MillisecondsFastest", point.time.fastest);
            add("MillisecondsSlowest", point.time.slowest);
            add("RatioToBaseline", point.time.ratio);
        }
    }
    return text;
}

} // namespace crossray
