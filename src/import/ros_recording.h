#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace sandstroke {

/// A topic of a recording.
struct RosTopic {
  std::string name, type;
  std::string encoding;        ///< of its messages: "cdr", "ros1", or another that is not read
  std::uint64_t messages = 0;  ///< how many
  std::set<std::int64_t> ids =
      {};  ///< of the topic in the recording; several, if several programs sent to it
};

/// A file with messages of ROS, of any format.
class RosRecording {
 public:
  virtual ~RosRecording() = default;
  virtual const char* kind() const = 0;  ///< "ROS 2 bag"
  virtual const std::string& name() const = 0;
  virtual std::vector<RosTopic> topics() = 0;

  /// Takes a message: when it was recorded [ns], and its bytes, which live until the next one.
  using Take = std::function<void(std::int64_t recorded, std::string_view bytes)>;
  /// Gives all messages of topics with these ids, in the order of the file. Error: io; input, if the file is
  /// damaged.
  virtual void read(const std::set<std::int64_t>& ids, const Take& take) = 0;
  /// Where the message is that is being taken: "message 3", "byte 120".
  virtual std::string place() const = 0;
  /// A sentence for each thing that is wrong but did not stop the reading.
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace sandstroke
