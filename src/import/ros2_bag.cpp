#include "import/ros2_bag.h"

#include <sqlite3.h>

#include <algorithm>
#include <memory>

#include "core/error.h"
#include "core/input_file.h"
#include "import/ros_samples.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

using Database = std::unique_ptr<sqlite3, decltype([](sqlite3* database) { sqlite3_close(database); })>;
using Statement = std::unique_ptr<sqlite3_stmt, decltype([](sqlite3_stmt* rows) { sqlite3_finalize(rows); })>;

class Ros2Bag : public RosRecording {
 public:
  explicit Ros2Bag(const fs::path& path);
  const char* kind() const override { return "ROS 2 bag"; }
  const std::string& name() const override { return name_; }
  std::vector<RosTopic> topics() override;
  void read(const std::set<std::int64_t>& ids, const Take& take) override;
  std::string place() const override { return fmt::format("message {}", number_); }

 private:
  Statement query(const char* sql);
  /// True if there is another row.
  bool step(const Statement& rows) const;
  std::string text(const Statement& rows, int column) const;

  std::string name_;
  Database database_;
  double steps_left_ = 0.0;
  std::size_t number_ = 0;  // of the message that is being taken
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

std::vector<RosTopic> Ros2Bag::topics() {
  const Statement rows = query(
      "SELECT topics.id, name, type, messages FROM topics LEFT JOIN (SELECT topic_id, count(*) AS messages "
      "FROM messages GROUP BY topic_id) ON topic_id = topics.id");
  std::vector<RosTopic> topics;
  while (step(rows))
    topics.push_back({text(rows, 1),
                      text(rows, 2),
                      "cdr",
                      static_cast<std::uint64_t>(sqlite3_column_int64(rows.get(), 3)),
                      {sqlite3_column_int64(rows.get(), 0)}});
  return topics;
}

void Ros2Bag::read(const std::set<std::int64_t>& ids, const Take& take) {
  number_ = 0;
  for (const std::int64_t id : ids) {
    const Statement rows =
        query("SELECT timestamp, data FROM messages WHERE topic_id = ? ORDER BY timestamp");
    sqlite3_bind_int64(rows.get(), 1, id);
    while (step(rows)) {
      ++number_;
      const auto* bytes = static_cast<const char*>(sqlite3_column_blob(rows.get(), 1));
      const auto size = static_cast<std::size_t>(sqlite3_column_bytes(rows.get(), 1));
      take(sqlite3_column_int64(rows.get(), 0), {bytes ? bytes : "", size});
    }
  }
}

}  // namespace

SampleTable read_ros2_bag(const fs::path& path, const std::string& part) {
  Ros2Bag bag(path);
  return ros_samples(bag, part);
}

}  // namespace sandstroke
