#include "harness/base/error.h"
#include "harness/scene/file_io.h"
#include "harness/scene/gbuffer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace crossray {

namespace {

using Json = nlohmann::json;

// A value of the file together with its dotted name, for messages.
class Value {
  public:
    Value(const std::filesystem::path& file, const Json& json, std::string name)
        : file_(file), json_(json), name_(std::move(name))
    {
    }

    [[noreturn]] void fail(const std::string& allowed) const
    {
        throw InputError({file_.string(), 0, 0},
                         fmt::format("{} is {}; allowed: {}", name_,
                                     json_.is_structured() ? json_.type_name() : json_.dump(), allowed));
    }

    bool has(const char* key) const { return json_.is_object() && json_.contains(key); }

    Value at(const char* key) const
    {
        const std::string inner = name_ == "the file" ? key : name_ + "." + key;
        if (!json_.is_object()) fail("a table");
        if (!json_.contains(key))
            throw InputError({file_.string(), 0, 0}, fmt::format("{} is missing; allowed: a value for it", inner));
        return {file_, json_.at(key), inner};
    }

    std::vector<Value> elements(size_t least, size_t most) const
    {
        if (!json_.is_array() || json_.size() < least || json_.size() > most)
            fail(least == most ? fmt::format("a list of {}", most) : fmt::format("a list of up to {}", most));
        std::vector<Value> result;
        for (size_t i = 0; i < json_.size(); ++i)
            result.emplace_back(file_, json_[i], fmt::format("{}[{}]", name_, i));
        return result;
    }

    double number() const
    {
        if (!json_.is_number() || !std::isfinite(json_.get<double>())) fail("a finite number");
        return json_.get<double>();
    }

    int pixels() const
    {
        const double value = number();
        if (value != std::floor(value) || std::abs(value) > 1e9) fail("a whole number of pixels");
        return static_cast<int>(value);
    }

    std::string text() const
    {
        if (!json_.is_string()) fail("a text");
        return json_.get<std::string>();
    }

    glm::dvec3 vector() const
    {
        const std::vector<Value> parts = elements(3, 3);
        return {parts[0].number(), parts[1].number(), parts[2].number()};
    }

  private:
    const std::filesystem::path& file_;
    const Json& json_;
    std::string name_;
};

Json parseJson(const std::filesystem::path& file)
{
    const std::string text = readWholeFile(file);
    try {
        return Json::parse(text);
    } catch (const Json::parse_error& error) {
        const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
        const int line = 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
        throw InputError({file.string(), line, 0}, "not valid JSON; allowed: one JSON table");
    } catch (const Json::out_of_range&) { // 1e999
        throw InputError({file.string(), 0, 0}, "a number is beyond what a double holds; allowed: finite numbers");
    }
}

glm::dmat4 readRigid(const Value& rows)
{
    glm::dmat4 matrix(1.0);
    const std::vector<Value> lines = rows.elements(4, 4);
    for (int row = 0; row < 4; ++row) {
        const std::vector<Value> numbers = lines[static_cast<size_t>(row)].elements(4, 4);
        for (int column = 0; column < 4; ++column)
            matrix[column][row] = numbers[static_cast<size_t>(column)].number();
    }
    constexpr double kFloatRounding = 1e-5;
    const glm::dmat3 rotation(matrix);
    const glm::dvec3 backWS = glm::normalize(rotation[2]);
    const glm::dvec3 rightWS = glm::normalize(glm::cross(rotation[1], backWS));
    const glm::dmat3 exact(rightWS, glm::cross(backWS, rightWS), backWS);
    for (int column = 0; column < 3; ++column)
        if (!(glm::length(exact[column] - rotation[column]) <= kFloatRounding)) rows.fail("a rotation and a position");
    const glm::dvec3 eyeWS(matrix[3]);
    matrix = glm::dmat4(exact);
    matrix[3] = glm::dvec4(eyeWS, 1.0);
    return matrix;
}

// Local z is the normal, local x is horizontal.
glm::dmat3 makePlaneFrame(const Value& normal, const glm::dvec3& upWS)
{
    const glm::dvec3 z = normal.vector();
    if (!(std::abs(glm::length(z) - 1.0) <= 1e-6)) normal.fail("a unit vector");
    const glm::dvec3 side = glm::cross(upWS, z);
    const glm::dvec3 x = glm::length(side) > 1e-6 ? glm::normalize(side) : glm::dvec3(1, 0, 0);
    return {x, glm::cross(z, x), z};
}

Primitive readPrimitive(const Value& value, const glm::dvec3& upWS)
{
    Primitive primitive;
    primitive.center = value.at("center").vector();
    primitive.radiance.colorA = value.has("color") ? value.at("color").vector() : glm::dvec3(0.0);
    const std::string shape = value.at("shape").text();
    if (shape == "plane") {
        primitive.shape = PrimitiveShape::kPlane;
        const std::vector<Value> half = value.at("half").elements(2, 2);
        primitive.halfExtents = {half[0].number(), half[1].number(), kNoLimit};
        primitive.worldFromLocal = makePlaneFrame(value.at("normal"), upWS);
    } else if (shape == "box") {
        primitive.shape = PrimitiveShape::kBox;
        primitive.halfExtents = value.at("half").vector();
    } else if (shape == "sphere") {
        primitive.shape = PrimitiveShape::kSphere;
        primitive.radius = value.at("radius").number();
    } else {
        value.at("shape").fail("plane, box, sphere");
    }
    if (value.has("material")) primitive.material = value.at("material").text();
    if (value.has("ior")) primitive.ior = value.at("ior").number();
    return primitive;
}

// The checks of a camera or scene do not know the file that it came from.
template <typename Check>
void checkInFile(const std::filesystem::path& file, const Check& check)
{
    try {
        check();
    } catch (const InputError& error) {
        throw InputError({file.string(), 0, 0}, error.what());
    }
}

} // namespace

Camera readCameraJson(const std::filesystem::path& file)
{
    const Json json = parseJson(file);
    const Value root(file, json, "the file");
    const Value lens = root.at("camera");
    const std::vector<Value> size = root.at("size").elements(2, 2);
    Camera camera;
    camera.width = size[0].pixels();
    camera.height = size[1].pixels();
    camera.fovYDegrees = lens.at("fov_y_deg").number();
    camera.nearDistance = lens.at("near").number();
    camera.farDistance = lens.at("far").number();
    camera.worldFromView = readRigid(root.at("camera_to_world_rows"));
    checkInFile(file, [&] { validateCamera(camera); });
    return camera;
}

Scene readSceneJson(const std::filesystem::path& file)
{
    constexpr size_t kMaxPrimitives = 4096;
    const Json json = parseJson(file);
    const Value root(file, json, "the file");
    Scene scene;
    scene.upWS = {0, 0, 1};
    scene.sky = {glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};
    if (root.has("primitives"))
        for (const Value& value : root.at("primitives").elements(0, kMaxPrimitives))
            scene.primitives.push_back(readPrimitive(value, scene.upWS));
    checkInFile(file, [&] { validateScene(scene); });
    return scene;
}

} // namespace crossray
