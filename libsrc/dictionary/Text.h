#pragma once

#include <string>

namespace caisson {

/// std::string by a printf format (std::format needs a newer compiler than Debian 12 has).
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

} // namespace caisson
