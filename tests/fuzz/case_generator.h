// Random cases from the schema's own keys, choices and ranges: a key that is added to the format is drawn from that day
// on.
#pragma once

#include "tests/fuzz/case_tree.h"

#include "harness/expect/expect.h"

#include <rapidcheck.h>

#include <cstdint>

namespace crossray {

// A tree with every kind of key; it need not be readable yet. What chooses a shader's variant (names, switches, which
// tables there are) comes from `structure`, numbers and the scene from `values`, so that many cases can share a
// variant.
Node drawCase(rc::Random structure, rc::Random values);

// Reads the tree and, where it is refused, does what the message says: takes away the key or the primitive that it
// points at, or draws the key that it misses; and so on until it is read. Null when that does not come to an end. Which
// keys go together is thus said by the reader alone, and a new rule needs no word here.
std::unique_ptr<CaseData> readOrRepair(Node& root, rc::Random structure, rc::Random values,
                                       const std::filesystem::path& file);

// Puts a surface that traces before the camera, at a random distance.
void addReceiver(Node& root, const Case& testCase, rc::Random values);

// Smaller and plainer cases, the boldest cut first.
rc::Seq<Node> shrinkCase(const Node& root);

// A readable random case and its cuts. Cases of one `structureSeed` share most of their shader variants.
rc::Gen<Node> genCase(uint64_t structureSeed, std::filesystem::path scratch);

} // namespace crossray
