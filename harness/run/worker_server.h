// The worker's side: a device that answers jobs over two pipes.
#pragma once

#include "harness/backend/device.h"

#include <functional>
#include <memory>

namespace crossray {

// Opens the device and answers jobs until `requestFd` closes. A job's error is an answer; a device that cannot be
// opened is answered by the reason. Returns the exit code of the process. When the other side closes its pipe while a
// job runs, the process ends by itself after a moment, so that no worker outlives the one who asked.
int serveJobs(int requestFd, int replyFd, const std::function<std::unique_ptr<Device>()>& open);

} // namespace crossray
