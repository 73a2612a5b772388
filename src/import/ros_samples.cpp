#include "import/ros_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/counted.h"
#include "core/error.h"
#include "import/ros_message.h"

namespace sandstroke {
namespace {

bool can_be_read(const RosTopic& topic) {
  return topic.messages > 0 && (topic.encoding == "cdr" || topic.encoding == "ros1") &&
         !ros_message_columns(topic.type).empty();
}

/// What `part` may name: a topic, or a frame that moves in it.
struct RosPart {
  RosTopic topic;
  std::string child, frame;
  std::uint64_t messages = 0;
  bool only = true;  // of its topic

  std::string long_name() const { return topic.name + ":" + child; }
  std::string name() const { return only ? topic.name : long_name(); }
  bool fits(const std::string& part) const {
    return part.empty() || part == topic.name || (!child.empty() && part == long_name());
  }
};

class RosSampleReader {
 public:
  explicit RosSampleReader(RosRecording& recording) : recording_(recording) { join_topics(); }

  SampleTable table(const std::string& part);

 private:
  void join_topics();
  std::vector<RosPart> parts(const std::string& part);
  std::vector<RosPart> parts_of(const RosTopic& topic);
  [[noreturn]] void ask(const std::string& part, const std::vector<RosPart>& fit);
  SampleTable table_of(const RosPart& part);
  void warn_of_count(const RosPart& part, std::uint64_t count);
  void warn_of_clocks();
  std::string described(const RosPart& part, std::size_t rows, bool has_stamps) const;
  void sort_rows(const std::vector<std::int64_t>& stamps);
  void leave_out_no_orientation();

  /// use: takes a RosMessage and when it was recorded.
  template <class Use>
  void for_each_message(const RosTopic& topic, const Use& use);

  RosRecording& recording_;
  std::vector<RosTopic> topics_;
  SampleTable table_;
  std::vector<std::int64_t> stamps_, recorded_;  // ns
};

/// Several programs that send to one topic have ids of their own.
void RosSampleReader::join_topics() {
  std::map<std::array<std::string, 3>, RosTopic> joined;
  for (const RosTopic& topic : recording_.topics()) {
    const auto [at, is_new] = joined.try_emplace({topic.name, topic.type, topic.encoding}, topic);
    if (is_new) continue;
    at->second.messages += topic.messages;
    at->second.ids.insert(topic.ids.begin(), topic.ids.end());
  }
  for (const auto& [key, topic] : joined) topics_.push_back(topic);
}

template <class Use>
void RosSampleReader::for_each_message(const RosTopic& topic, const Use& use) {
  const RosEncoding encoding = topic.encoding == "ros1" ? RosEncoding::ros1 : RosEncoding::cdr;
  recording_.read(topic.ids, [&](std::int64_t recorded, std::string_view bytes) {
    const auto messages = ros_messages(topic.type, bytes, encoding);
    if (!messages) {
      const bool packed = bytes.starts_with("\x28\xB5\x2F\xFD");
      throw_input_error("{}: {} of {} is not a {}{}", recording_.name(), recording_.place(), topic.name,
                        topic.type,
                        packed ? ", but compressed; unpack the bag: ros2 bag convert"
                               : fmt::format(" in {}; take another copy of the recording",
                                             encoding == RosEncoding::cdr ? "CDR" : "the bytes of ROS 1"));
    }
    for (const RosMessage& message : *messages) use(message, recorded);
  });
}

std::vector<RosPart> RosSampleReader::parts_of(const RosTopic& topic) {
  if (!ros_type_names_child(topic.type)) return {{topic, "", "", topic.messages}};
  constexpr std::size_t most = 10'000;
  std::map<std::string, RosPart> by_child;
  for_each_message(topic, [&](const RosMessage& message, std::int64_t) {
    RosPart& part =
        by_child.try_emplace(message.child, RosPart{topic, message.child, message.frame}).first->second;
    ++part.messages;
    if (by_child.size() > most)
      throw_input_error("{}: {} has more than {} frames; record the tool's frame alone", recording_.name(),
                        topic.name, most);
  });
  std::vector<RosPart> parts;
  for (auto& [child, part] : by_child) {
    part.only = by_child.size() == 1;
    parts.push_back(part);
  }
  return parts;
}

/// The parts of all topics that `part` may be about.
std::vector<RosPart> RosSampleReader::parts(const std::string& part) {
  std::vector<RosPart> parts;
  for (const RosTopic& topic : topics_) {
    const bool asked = part.empty() || part == topic.name || part.starts_with(topic.name + ":");
    if (!asked || !can_be_read(topic)) continue;
    for (RosPart& one : parts_of(topic)) parts.push_back(std::move(one));
  }
  return parts;
}

SampleTable RosSampleReader::table(const std::string& part) {
  std::vector<RosPart> fit = parts(part);
  std::erase_if(fit, [&](const RosPart& one) { return !one.fits(part); });
  if (fit.size() != 1) ask(part, fit);
  return table_of(fit.front());
}

/// At most as many as a person reads.
std::string list_of_names(std::vector<std::string> names) {
  constexpr std::size_t most = 40;
  return names.empty() ? "none" : first_of(std::move(names), most);
}

void RosSampleReader::ask(const std::string& part, const std::vector<RosPart>& fit) {
  const auto warnings = recording_.warnings();
  const std::string told = warnings.empty() ? "" : fmt::format(" ({})", fmt::join(warnings, "; "));
  std::vector<std::string> all, choices;
  for (const RosTopic& topic : topics_)
    all.push_back(fmt::format(
        "{} ({}{}, {} messages)", topic.name, topic.type.empty() ? "no type" : topic.type,
        topic.encoding == "cdr" || topic.encoding == "ros1" ? "" : " in " + topic.encoding, topic.messages));
  for (const RosPart& one : fit.empty() ? parts("") : fit)
    choices.push_back(fmt::format("{} ({}, {} messages{})", one.name(), one.topic.type, one.messages,
                                  one.only || one.frame.empty() ? "" : ", in " + one.frame));
  if (choices.empty()) {
    throw_input_error(
        "{}: no topic has messages with a position or a force that sandstroke reads ({}; in cdr or ros1); "
        "record the tool as one of these; the {} has: {}{}",
        recording_.name(), ros_types_read(), recording_.kind(), list_of_names(all), told);
  }
  const std::string choose =
      fmt::format("name one of its topics with stroke.table.part (stroke convert: --part): {}{}",
                  list_of_names(choices), told);
  if (fit.size() > 1)
    throw_input_error("{}: several {} can be read; {}", recording_.name(),
                      part.empty() ? "topics" : "frames of " + part, choose);
  throw_input_error("{}: topic '{}' cannot be read; {}", recording_.name(), part, choose);
}

/// Sorts the rows by their stamps, and fills the columns of time.
void RosSampleReader::sort_rows(const std::vector<std::int64_t>& stamps) {
  std::vector<std::size_t> order(stamps.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(stamps[a], recorded_[a]) < std::pair(stamps[b], recorded_[b]);
  });
  for (SampleColumn& column : table_.columns) {
    std::vector<double> ordered;
    for (const std::size_t row : order) ordered.push_back(column.values[row]);
    column.values = std::move(ordered);
  }
  const auto since_first = [&](const char* name, const std::vector<std::int64_t>& times) {
    SampleColumn column{name, "ns", {}, times[order.front()]};
    for (const std::size_t row : order) {
      std::int64_t since = 0;  // stamps of a damaged file may differ by more than it holds
      const bool beyond = __builtin_sub_overflow(times[row], *column.origin, &since);
      column.values.push_back(beyond ? 0x1p63 : static_cast<double>(since));
    }
    return column;
  };
  table_.columns.insert(table_.columns.begin(), since_first("time", stamps));
  if (&stamps != &recorded_) table_.columns.push_back(since_first("recorded", recorded_));
}

/// Senders that know no orientation leave its quaternion at 0.
void RosSampleReader::leave_out_no_orientation() {
  const auto is_of_orientation = [](const SampleColumn& column) { return column.name.starts_with('q'); };
  const bool all_zero = std::all_of(table_.columns.begin(), table_.columns.end(), [&](const auto& column) {
    return !is_of_orientation(column) ||
           std::all_of(column.values.begin(), column.values.end(), [](double value) { return value == 0.0; });
  });
  if (!all_zero) return;
  if (std::erase_if(table_.columns, is_of_orientation) > 0)
    table_.description += ", orientation left out because its quaternions are 0";
}

void RosSampleReader::warn_of_count(const RosPart& part, std::uint64_t count) {
  if (count != part.messages)
    table_.warnings.push_back(
        fmt::format("{}: {} has {} messages, but the summary of the file counts {}; parts of the file may be "
                    "missing",
                    recording_.name(), part.name(), count, part.messages));
}

/// Warns if the headers' clock and the recorder's tell different things.
void RosSampleReader::warn_of_clocks() {
  const auto seconds = [](std::int64_t ns) { return 1e-9 * static_cast<double>(ns); };
  const auto span = [&](const std::vector<std::int64_t>& times) {
    const auto [first, last] = std::minmax_element(times.begin(), times.end());
    return seconds(*last) - seconds(*first);
  };
  constexpr double most_late = 5.0;      // s, from sender to recorder
  constexpr double most_stretch = 0.05;  // of the span
  const double of_stamps = span(stamps_), of_recorder = span(recorded_);
  const double late = seconds(recorded_.front()) - seconds(stamps_.front());
  std::string differ;
  if (std::abs(of_stamps - of_recorder) > std::max(1.0, most_stretch * of_recorder))
    differ = fmt::format("span {:.3f} s, but the recorder's times {:.3f} s", of_stamps, of_recorder);
  else if (std::abs(late) > most_late)
    differ = fmt::format("begin {:.3f} s {} the recorder's times", std::abs(late),
                         late > 0.0 ? "before" : "after");
  if (!differ.empty())
    table_.warnings.push_back(
        fmt::format("{}: the stamps in the headers {}; the headers are taken: to take the recorder's, name "
                    "the column recorded with stroke.table.time (stroke convert: --time)",
                    recording_.name(), differ));
}

std::string RosSampleReader::described(const RosPart& part, std::size_t rows, bool has_stamps) const {
  std::string text =
      fmt::format("{}: {} messages of {} ({})", recording_.kind(), rows, part.topic.name, part.topic.type);
  if (!part.child.empty()) text += fmt::format(", frame {}", part.child);
  if (!part.frame.empty()) text += fmt::format(" in frame {}", part.frame);
  text += fmt::format(", time from {}", has_stamps ? "their headers" : "the recorder");
  if (ros_type_has_velocity(part.topic.type))
    text += ", velocity left out because it is in the frame that moves";
  return text;
}

SampleTable RosSampleReader::table_of(const RosPart& part) {
  table_.columns = ros_message_columns(part.topic.type);
  RosPart read = part;
  std::string other_frame;
  std::size_t not_finite = 0;
  for_each_message(part.topic, [&](const RosMessage& message, std::int64_t recorded) {
    if (message.child != part.child) return;
    if (stamps_.empty()) read.frame = message.frame;
    if (message.frame != read.frame && other_frame.empty()) other_frame = message.frame;
    stamps_.push_back(message.stamp);
    recorded_.push_back(recorded);
    bool finite = true;
    for (std::size_t i = 0; i < message.values.size(); ++i) {
      const double value = message.values[i];
      finite = finite && std::isfinite(value);
      table_.columns[i].values.push_back(std::isinf(value) ? std::numeric_limits<double>::quiet_NaN()
                                                           : value);
    }
    not_finite += !finite;
  });
  table_.warnings = recording_.warnings();
  if (not_finite == stamps_.size())
    throw_input_error("{}: no message of {} has finite numbers; name another topic", recording_.name(),
                      part.name());
  const bool has_stamps =
      std::any_of(stamps_.begin(), stamps_.end(), [](std::int64_t stamp) { return stamp != 0; });
  table_.description = described(read, stamps_.size(), has_stamps);
  if (not_finite > 0) table_.description += fmt::format(", {} with numbers that are not finite", not_finite);
  if (!other_frame.empty())
    table_.warnings.push_back(fmt::format(
        "{}: messages of {} are in frame '{}' and in frame '{}', whose axes may differ; record one frame",
        recording_.name(), part.name(), read.frame, other_frame));
  warn_of_count(part, stamps_.size());
  if (has_stamps) warn_of_clocks();
  leave_out_no_orientation();
  sort_rows(has_stamps ? stamps_ : recorded_);
  return std::move(table_);
}

}  // namespace

SampleTable ros_samples(RosRecording& recording, const std::string& part) {
  return RosSampleReader(recording).table(part);
}

}  // namespace sandstroke
