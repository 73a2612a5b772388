#pragma once

#include <string>

#include "import/ros_recording.h"
#include "import/sample_table.h"

namespace sandstroke {

/// Reads one topic of a recording: position, orientation, force and torque of ros_message_columns(); `time`
/// in ns since the first stamp; and `recorded`, when the recorder got it. The stamps are those of the
/// messages' headers, or the recorder's if they have none. They count from 1970 or from the simulation's
/// beginning. Rows are in the order of the stamps. A number that is infinite is NaN.
/// `part` names the topic, or TOPIC:FRAME for one of several frames that move in it; it may be empty if there
/// is only one. Warns if headers and recorder disagree, and if the messages change their frame. Error: io;
/// input, listing the topics and frames.
SampleTable ros_samples(RosRecording& recording, const std::string& part);

}  // namespace sandstroke
