#pragma once

#include <nlohmann/json.hpp>

#include "haptics/recording.h"

namespace sandstroke {

// Header and footer of a recording as JSON objects, with the names of recording_fields.h. Numbers that are
// not finite become null.

nlohmann::ordered_json as_json(const RecordingHeader& header);
nlohmann::ordered_json as_json(const RecordingFooter& footer);

/// Throws nlohmann::json::exception where a field is missing or of another kind, or a count is invalid.
RecordingHeader header_from_json(const nlohmann::ordered_json& json);
RecordingFooter footer_from_json(const nlohmann::ordered_json& json);

}  // namespace sandstroke
