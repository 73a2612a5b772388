#include "import/inkml.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/input_file.h"
#include "import/sample_checks.h"
#include "import/text_parts.h"
#include "import/xml_parts.h"

namespace sandstroke {
namespace {

/// The nodes of a document that are used, wherever they stand. pugixml walks without recursion.
struct InkNodes : pugi::xml_tree_walker {
  std::vector<pugi::xml_node> traces, formats, properties;
  pugi::xml_node sample_rate;

  bool for_each(pugi::xml_node& node) override {
    const std::string_view name = local_name(node);
    if (name == "trace") traces.push_back(node);
    if (name == "traceFormat") formats.push_back(node);
    if (name == "channelProperty") properties.push_back(node);
    if (name == "sampleRate") sample_rate = node;
    return true;
  }
};

struct InkChannel {
  std::string name, unit;
  std::optional<double> least, most;  // of the numbers in the file
  double sign = 1.0;                  // of the column: y points down in InkML
  double per_unit = 1.0;
};

std::string column_of_channel(const std::string& channel) {
  const std::map<std::string, std::string> names{
      {"X", "x"}, {"Y", "y"}, {"Z", "z"}, {"T", "time"}, {"F", "pressure"}};
  const auto found = names.find(channel);
  return found == names.end() ? channel : found->second;
}

std::vector<InkChannel> channels_of(const pugi::xml_node& format) {
  std::vector<InkChannel> channels;
  for (const pugi::xml_node& node : format.children()) {
    if (local_name(node) != "channel") continue;
    const std::string name = node.attribute("name").value(), unit = node.attribute("units").value();
    channels.push_back({column_of_channel(name), unit == "dev" ? "" : unit,
                        finite_number(node.attribute("min").value()),
                        finite_number(node.attribute("max").value())});
    if (name == "T" && unit.empty()) channels.back().unit = "ms";
    const bool turned = std::string_view(node.attribute("orientation").value()) == "-ve";
    if (name == "X" || name == "Y" || name == "Z")
      channels.back().sign = turned == (name == "Y") ? 1.0 : -1.0;
  }
  return channels;
}

/// Takes a device's points per length, "1/cm".
void take_resolution(const pugi::xml_node& property, std::vector<InkChannel>& channels) {
  const std::string_view units = property.attribute("units").value();
  const std::optional<double> value = finite_number(property.attribute("value").value());
  if (std::string_view(property.attribute("name").value()) != "resolution" || !units.starts_with("1/"))
    return;
  if (!value || !(*value > 0.0)) return;
  for (InkChannel& channel : channels) {
    if (channel.name != column_of_channel(property.attribute("channel").value())) continue;
    channel.unit = units.substr(2);
    channel.per_unit = *value;
  }
}

/// One channel's values in a trace, which may be differences.
class InkValue {
 public:
  /// Takes the next value off the text of a point.
  std::optional<double> cut(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    if (constexpr std::string_view marks = "!'\"";
        !text.empty() && marks.find(text[0]) != std::string_view::npos) {
      order_ = static_cast<int>(marks.find(text[0]));
      text.remove_prefix(1);
      text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    }
    if (text.empty()) return {};
    if (text[0] == '*' || text[0] == 'T' || text[0] == 'F') {
      if (text[0] != '*') given_ = text[0] == 'T' ? 1.0 : 0.0;
      text.remove_prefix(1);
    } else {
      const char* begin = text.data() + (text[0] == '+' ? 1 : 0);
      const auto [end, failure] = std::from_chars(begin, text.data() + text.size(), given_);
      if (failure != std::errc()) return {};
      text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    }
    const double before = value_;
    if (order_ == 0) value_ = given_;
    if (order_ == 1) value_ += given_;
    if (order_ == 2) value_ += change_ + given_;
    change_ = value_ - before;
    if (!std::isfinite(value_)) return {};
    return value_;
  }

 private:
  int order_ = 0;  // of the given differences
  double given_ = 0.0, value_ = 0.0, change_ = 0.0;
};

class InkmlReader {
 public:
  InkmlReader(const pugi::xml_node& document, const std::string& name) : name_(name) {
    pugi::xml_node root = document;
    root.traverse(nodes_);
    take_channels();
    if (const auto rate = finite_number(nodes_.sample_rate.attribute("value").value()); rate && *rate > 0.0)
      rate_ = *rate;
  }

  SampleTable table() {
    for (const InkChannel& channel : channels_) table_.columns.push_back({channel.name, channel.unit, {}});
    std::size_t strokes = 0;
    for (const pugi::xml_node& trace : nodes_.traces) {
      ++trace_;
      if (std::string_view(trace.attribute("type").value()) == "penUp") continue;
      const std::string_view continues = trace.attribute("continuation").value();
      const bool goes_on = continues == "middle" || continues == "end";
      if (goes_on && !table_.lifts.empty()) table_.lifts.back() = false;
      strokes += goes_on ? 0 : 1;
      take_trace(trace);
    }
    if (table_.size() == 0)
      throw_input_error("{}: has no points in traces; give a file with pen strokes", name_);
    const bool has_time =
        std::any_of(channels_.begin(), channels_.end(), [](const auto& one) { return one.name == "time"; });
    if (!has_time && rate_ > 0.0) table_.columns.push_back({"time", "s", std::move(times_)});
    warn_of_values_beyond();
    table_.description = fmt::format("InkML: {} pen strokes, {} samples, y points {} in the file{}", strokes,
                                     table_.size(), y_is_negated() ? "down" : "up (orientation -ve)",
                                     y_is_negated() ? " and is negated" : "");
    return std::move(table_);
  }

 private:
  void take_channels() {
    channels_ = {{"x", "", {}, {}}, {"y", "", {}, {}, -1.0}};
    for (const pugi::xml_node& format : nodes_.formats) {
      const std::vector<InkChannel> channels = channels_of(format);
      const bool same = std::equal(channels.begin(), channels.end(), channels_.begin(), channels_.end(),
                                   [](const InkChannel& a, const InkChannel& b) { return a.name == b.name; });
      if (format != nodes_.formats.front() && !same)
        throw_input_error("{}: its traces have several formats (traceFormat); save one file for each format",
                          name_);
      channels_ = channels;
    }
    for (const char* needed : {"x", "y"})
      if (std::count_if(channels_.begin(), channels_.end(),
                        [&](const auto& one) { return one.name == needed; }) != 1)
        throw_input_error("{}: traceFormat must have the channels X and Y once each; correct it", name_);
    for (const pugi::xml_node& property : nodes_.properties) take_resolution(property, channels_);
  }

  bool y_is_negated() const {
    return std::any_of(channels_.begin(), channels_.end(),
                       [](const InkChannel& one) { return one.name == "y" && one.sign < 0.0; });
  }

  /// A resolution, a unit or a format that is wrong shows where values leave their channel's range.
  void warn_of_values_beyond() {
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      const InkChannel& channel = channels_[i];
      const auto& values = table_.columns[i].values;
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      double least = channel.sign * *low * channel.per_unit, most = channel.sign * *high * channel.per_unit;
      if (least > most) std::swap(least, most);
      const double rounding = 1e-9 * std::max(std::abs(least), std::abs(most));
      if (channel.least.value_or(least) <= least + rounding && most - rounding <= channel.most.value_or(most))
        continue;
      const auto bound = [](const std::optional<double>& value) {
        return value ? fmt::format("{:g}", *value) : std::string("any");
      };
      table_.warnings.push_back(
          fmt::format("{}: the channel of {} has values from {:g} to {:g}, but traceFormat says {} to {}; "
                      "see whether its "
                      "unit and resolution are those of the values",
                      name_, channel.name, least, most, bound(channel.least), bound(channel.most)));
    }
  }

  void take_trace(const pugi::xml_node& trace) {
    const std::string all = trace.text().get();
    std::vector<InkValue> values(channels_.size());
    const auto offset = finite_number(trace.attribute("timeOffset").value());
    const std::size_t begin = table_.size();
    for (std::string_view rest = without_blanks(all); !rest.empty();) {
      std::string_view point = without_blanks(cut_before(rest, ','));
      const std::string_view whole = point;
      for (std::size_t i = 0; i < channels_.size(); ++i) {
        const std::optional<double> value = values[i].cut(point);
        if (!value) {
          throw_input_error(
              "{}: trace {}, point {}: '{}' does not have a finite number for each of the {} channels; "
              "correct it",
              name_, trace_, table_.lifts.size() - begin + 1, whole.substr(0, 60), channels_.size());
        }
        table_.columns[i].values.push_back(channels_[i].sign * *value / channels_[i].per_unit);
      }
      const std::size_t since = offset ? table_.lifts.size() - begin : table_.lifts.size();
      if (rate_ > 0.0) times_.push_back(1e-3 * offset.value_or(0.0) + static_cast<double>(since) / rate_);
      table_.lifts.push_back(false);
    }
    if (table_.lifts.size() > begin) table_.lifts.back() = true;
  }

  const std::string& name_;
  InkNodes nodes_;
  std::vector<InkChannel> channels_;
  double rate_ = 0.0;      // Hz
  std::size_t trace_ = 0;  // from 1
  std::vector<double> times_;
  SampleTable table_;
};

}  // namespace

SampleTable parse_inkml(std::string_view text, const std::string& name) {
  pugi::xml_document document;
  parse_xml(text, name, document);
  return finite_samples(InkmlReader(document, name).table(), name);
}

SampleTable read_inkml(const std::filesystem::path& path) {
  return parse_inkml(read_text_file(path, most_xml_bytes), path.string());
}

}  // namespace sandstroke
