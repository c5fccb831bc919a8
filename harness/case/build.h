// From a checked tree of values to the parts of a Case. What single keys cannot say is checked here: how keys fit
// together.
#pragma once

#include "harness/case/case.h"
#include "harness/case/schema.h"

#include <filesystem>
#include <functional>
#include <string>

namespace crossray {

// Looks up [tolerance.NAME] of presets.toml; throws InputError at the place that names it.
using ToleranceLookup = std::function<const Node&(const Node& name)>;

// The case that a tree states whose presets are laid in and whose [expand] is taken out. Throws InputError.
Case buildCase(const Node& root, const std::filesystem::path& file, const Node* presets);
// A value as it would stand in the file; what is not TOML is a string, so that `--set projection.model=hiz` needs no
// quotes. Messages about it name the path.
Node parseOverride(const std::string& path, const std::string& text);

void buildScene(const TableReader& top, Case& testCase);
void buildCamera(const TableReader& top, Case& testCase);
void buildRecorded(const TableReader& top, Case& testCase);
void buildMaterial(const TableReader& top, Case& testCase);
void buildThicknessMap(const TableReader& material, Case& testCase);
void buildProjection(const TableReader& top, Case& testCase);
void buildHistory(const TableReader& top, Case& testCase); // after buildScene and buildCamera
void buildProbes(const TableReader& top, Case& testCase);
void buildProfile(const TableReader& top, Case& testCase);   // after buildScene and buildMaterial
void buildSky(const TableReader& top, Case& testCase);       // after buildScene
void buildHierarchy(const TableReader& top, Case& testCase); // after buildProbes
void buildExpectations(const Node& root, const ToleranceLookup& findTolerance, Case& testCase);
// Expectations of every output become one of each; after Case::outputs is known.
void spreadOverOutputs(Case& testCase);
void buildKnownFailures(const Node& root, Case& testCase);

// Of a value that is Euler degrees [x, y, z], applied about the fixed x axis, then y, then z, or { axis, degrees }.
glm::dmat3 buildRotation(const Node& value);
glm::dvec3 readVec3(const TableReader& table, std::string_view key);
Sky readGradient(const TableReader& table);

// What a cubemap shows: [environment]. `probe` is the number of the [[probe]] that it belongs to, from 1; 0: the sky's.
Environment buildEnvironment(const TableReader& table, const Case& testCase, int probe);
// [probe.mirror] of a planar probe.
ProbeMirror buildMirror(const TableReader& probeTable, const Case& testCase, const glm::dvec3& influenceCenter);

// A path that a case names: relative, and inside the folder of the case, also after links are followed.
std::filesystem::path resolveInside(const Case& testCase, const Node& path, std::string_view key, bool mustExist);

} // namespace crossray
