// Makes the report of a crowd of bots.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "loadgen/run/bots/bot_crowd.h"

namespace rink::loadgen {

/// The bots' report, valid unless there is a reason `why_invalid`.
nlohmann::ordered_json bots_report(const BotCrowd& crowd, const std::string& why_invalid);

}  // namespace rink::loadgen
