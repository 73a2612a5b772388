#include "import/ros2_bag.h"

#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "core/error.h"
#include "core/input_file.h"
#include "import/ros_message.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

using Database = std::unique_ptr<sqlite3, decltype([](sqlite3* database) { sqlite3_close(database); })>;
using Statement = std::unique_ptr<sqlite3_stmt, decltype([](sqlite3_stmt* rows) { sqlite3_finalize(rows); })>;

struct BagTopic {
  std::int64_t id = 0, messages = 0;
  std::string name, type;

  bool readable() const { return messages > 0 && !ros_message_columns(type).empty(); }
};

class Ros2Bag {
 public:
  explicit Ros2Bag(const fs::path& path);
  std::vector<BagTopic> topics();
  SampleTable table(const BagTopic& topic);

 private:
  Statement query(const char* sql);
  /// True if there is another row.
  bool step(const Statement& rows) const;
  std::string text(const Statement& rows, int column) const;

  std::string name_;
  Database database_;
  double steps_left_ = 0.0;
};

/// A URI that SQLite opens only for reading, and without looking for a writer.
std::string read_only_uri(const fs::path& path) {
  std::string uri = "file:";
  for (const char c : fs::absolute(path).string())
    uri += std::string_view("?#%").find(c) == std::string_view::npos
               ? std::string(1, c)
               : fmt::format("%{:02X}", static_cast<int>(c));
  return uri + "?mode=ro&immutable=1";
}

Ros2Bag::Ros2Bag(const fs::path& path) : name_(path.string()) {
  check_readable(path);
  std::error_code none;
  if (const auto bytes = fs::file_size(name_ + "-wal", none); !none && bytes > 0) {
    throw_input_error(
        "{}: the bag was not closed ({}-wal is still there); close it: sqlite3 {} 'PRAGMA wal_checkpoint'",
        name_, name_, name_);
  }
  sqlite3* opened = nullptr;
  const int failure =
      sqlite3_open_v2(read_only_uri(path).c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  database_.reset(opened);
  if (failure != SQLITE_OK)
    throw_io_error("{}: cannot be opened ({}); check the path", name_, sqlite3_errstr(failure));
  // The file is a stranger's: allow no views, no functions with effects, no values larger than the file, and
  // only so many steps.
  sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  const double bytes = static_cast<double>(fs::file_size(path));
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, static_cast<int>(std::clamp(bytes, 1e6, 1e9)));
  constexpr int at_once = 1000;
  steps_left_ = 1e3 + bytes / 10.0;  // a row has tens of bytes, and takes tens of steps
  const auto stop = [](void* left) { return (*static_cast<double*>(left) -= 1.0) < 0.0 ? 1 : 0; };
  sqlite3_progress_handler(opened, at_once, stop, &steps_left_);
}

Statement Ros2Bag::query(const char* sql) {
  sqlite3_stmt* rows = nullptr;
  const int failure = sqlite3_prepare_v2(database_.get(), sql, -1, &rows, nullptr);
  if (failure == SQLITE_ERROR) {
    throw_input_error(
        "{}: is an SQLite file without ROS messages (tables topics and messages); name a bag, or save a "
        "table of samples as CSV",
        name_);
  }
  if (failure != SQLITE_OK)
    throw_input_error("{}: cannot be read ({}); take another copy of the bag", name_,
                      sqlite3_errstr(failure));
  return Statement(rows);
}

bool Ros2Bag::step(const Statement& rows) const {
  const int answer = sqlite3_step(rows.get());
  if (answer == SQLITE_IOERR) throw_io_error("{}: cannot be read; check the disk", name_);
  if (answer != SQLITE_ROW && answer != SQLITE_DONE)
    throw_input_error("{}: is damaged ({}); take another copy of the bag", name_, sqlite3_errstr(answer));
  return answer == SQLITE_ROW;
}

std::string Ros2Bag::text(const Statement& rows, int column) const {
  const unsigned char* text = sqlite3_column_text(rows.get(), column);
  return text ? reinterpret_cast<const char*>(text) : "";
}

std::vector<BagTopic> Ros2Bag::topics() {
  const Statement rows = query(
      "SELECT topics.id, name, type, messages FROM topics LEFT JOIN (SELECT topic_id, count(*) AS messages "
      "FROM "
      "messages GROUP BY topic_id) ON topic_id = topics.id ORDER BY name");
  std::vector<BagTopic> topics;
  while (step(rows))
    topics.push_back({sqlite3_column_int64(rows.get(), 0), sqlite3_column_int64(rows.get(), 3), text(rows, 1),
                      text(rows, 2)});
  return topics;
}

/// Fills the first column with the time since the first stamp, and sorts the rows by it: headers may be in
/// another order than their messages.
void set_stamps(SampleTable& table, const std::vector<std::int64_t>& stamps) {
  std::vector<std::size_t> order(stamps.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return stamps[a] < stamps[b]; });
  for (SampleColumn& column : table.columns) {
    std::vector<double> ordered;
    for (const std::size_t row : order)
      if (!column.values.empty()) ordered.push_back(column.values[row]);
    column.values = std::move(ordered);
  }
  SampleColumn& time = table.columns.front();
  time.origin = stamps[order.front()];
  for (const std::size_t row : order) {
    std::int64_t since = 0;  // stamps of a damaged file may differ by more than it holds
    const bool beyond = __builtin_sub_overflow(stamps[row], *time.origin, &since);
    time.values.push_back(beyond ? 0x1p63 : static_cast<double>(since));
  }
}

SampleTable Ros2Bag::table(const BagTopic& topic) {
  SampleTable table;
  table.columns = ros_message_columns(topic.type);
  std::vector<std::int64_t> stamps, received;  // ns
  std::size_t left_out = 0;
  const Statement rows = query("SELECT timestamp, data FROM messages WHERE topic_id = ? ORDER BY timestamp");
  sqlite3_bind_int64(rows.get(), 1, topic.id);
  while (step(rows)) {
    const auto* bytes = static_cast<const char*>(sqlite3_column_blob(rows.get(), 1));
    const std::string_view data(bytes ? bytes : "",
                                static_cast<std::size_t>(sqlite3_column_bytes(rows.get(), 1)));
    const std::optional<RosMessage> message = ros_message(topic.type, data);
    if (!message) {
      throw_input_error(
          "{}: message {} of {} is not a {}{}", name_, stamps.size() + left_out + 1, topic.name, topic.type,
          data.starts_with("\x28\xB5\x2F\xFD") ? ", but compressed; unpack the bag: ros2 bag convert"
                                               : " in CDR; take another copy of the bag");
    }
    if (!std::all_of(message->values.begin(), message->values.end(),
                     [](double value) { return std::isfinite(value); })) {
      ++left_out;
      continue;
    }
    stamps.push_back(message->stamp);
    received.push_back(sqlite3_column_int64(rows.get(), 0));
    for (std::size_t i = 0; i < message->values.size(); ++i)
      table.columns[i].values.push_back(message->values[i]);
  }
  if (stamps.empty())
    throw_input_error("{}: no message of {} has finite numbers; name another topic", name_, topic.name);
  const bool has_stamps =
      std::any_of(stamps.begin(), stamps.end(), [](std::int64_t stamp) { return stamp != 0; });
  table.columns.insert(table.columns.begin(), {"time", "ns", {}});
  set_stamps(table, has_stamps ? stamps : received);
  table.description =
      fmt::format("ROS 2 bag: {} messages of {} ({}), time from {}{}", stamps.size(), topic.name, topic.type,
                  has_stamps ? "their headers" : "the bag",
                  left_out ? fmt::format(", {} left out because they are not finite", left_out) : "");
  return table;
}

}  // namespace

SampleTable read_ros2_bag(const fs::path& path, const std::string& topic) {
  Ros2Bag bag(path);
  std::vector<BagTopic> fit;
  std::vector<std::string> all, readable;
  for (const BagTopic& one : bag.topics()) {
    all.push_back(fmt::format("{} ({}, {} messages)", one.name, one.type, one.messages));
    if (!one.readable()) continue;
    readable.push_back(all.back());
    if (topic.empty() || one.name == topic) fit.push_back(one);
  }
  if (fit.size() == 1) return bag.table(fit.front());
  if (readable.empty()) {
    throw_input_error(
        "{}: no topic has messages with a position or a force (geometry_msgs' Point, Pose, Transform, "
        "Wrench, also "
        "Stamped); it has: {}",
        path.string(), all.empty() ? "none" : fmt::format("{}", fmt::join(all, ", ")));
  }
  const std::string choose =
      fmt::format("name one of its topics with stroke.table.part (stroke convert: --part): {}",
                  fmt::join(readable, ", "));
  if (topic.empty()) throw_input_error("{}: several topics can be read; {}", path.string(), choose);
  throw_input_error("{}: topic '{}' cannot be read; {}", path.string(), topic, choose);
}

}  // namespace sandstroke
