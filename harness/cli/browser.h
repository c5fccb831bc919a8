// The system's browser.
#pragma once

#include <string>

namespace crossray {

// Opens a file or an address and comes back at once. Throws EnvironmentError when there is no xdg-open.
void openInBrowser(const std::string& place);

} // namespace crossray
