// What each backend needs of its process: files to be found, variables to be set before its libraries load.
#pragma once

#include "harness/run/worker_pool.h"

#include <map>
#include <string>

namespace crossray {

// Variables of a worker's environment; an empty value removes one. An unknown backend gets what all of them get.
std::map<std::string, std::string> workerEnvironment(const std::string& backend, const WorkerOptions& options);

} // namespace crossray
