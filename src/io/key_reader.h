#pragma once

#include <string>

#include "core/key_visitor.h"
#include "io/toml_reader.h"

namespace sandstroke {

/// Gives each key the value in the file, if there is one. Error: input, as TomlReader says it.
class KeyReader : public KeyVisitor {
 public:
  explicit KeyReader(const TomlReader& toml) : toml_(toml) {}

  void section(const char* name, const char* help) override;
  bool optional_section(const char* name, bool present, const char* help) override;
  bool given(const char* key) override;
  void require(const char* key) override;
  void number(const char* key, double& value, Range range, const char* unit, const char* help) override;
  void numbers(const char* key, double* values, int count, Range range, const char* unit,
               const char* help) override;
  void profile(const char* key, std::vector<double>& values, Range range, const char* unit,
               const char* help) override;
  void points(const char* key, std::vector<Eigen::Vector2d>& values, const char* unit,
              const char* help) override;
  void integers(const char* key, int* values, int count, int lowest, int highest, const char* help) override;
  void flag(const char* key, bool& value, const char* help) override;
  void text(const char* key, std::string& value, const char* help) override;
  void texts(const char* key, std::vector<std::string>& values, const char* help) override;
  void choice(const char* key, int& value, const std::vector<std::string>& names, const char* help) override;
  bool reads() const override { return true; }

 private:
  const TomlReader& toml_;
  std::string prefix_;
};

}  // namespace sandstroke
