#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "import/text_decoder.h"

namespace sandstroke {

/// Splits a text in any encoding, given part by part, into its lines.
class TextLines {
 public:
  /// A line without spaces at both ends, and its number from 1 on. Tabs stay: they may separate empty fields.
  using Take = std::function<void(std::string_view line, std::size_t number)>;

  /// `name` stands for the file in sentences.
  TextLines(const std::string& name, const std::string& encoding) : name_(name), decoder_(name, encoding) {}

  /// Gives out the lines that end in the next bytes. Error: input, if a line is too long or is no text.
  void read(std::string_view bytes, const Take& take) { read_text(decoder_.decode(bytes), take); }
  /// Gives out the last line, if it has no end of line.
  void end(const Take& take);

  /// The given or found encoding; empty: UTF-8.
  const std::string& encoding() const { return decoder_.encoding(); }

 private:
  void read_text(std::string_view part, const Take& take);
  void extend_line(std::string_view part);
  void end_line(const Take& take);

  std::string name_;
  TextDecoder decoder_;
  std::size_t line_ = 0;       // number of the last whole line
  bool after_return_ = false;  // a \r ended the last line: a \n right after it belongs to it
  std::string rest_;           // the beginning of a line that has not ended
};

}  // namespace sandstroke
