#include "compare/junit.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

#include "core/version.h"

namespace sandstroke {
namespace {

struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::vector<Element> children;
};

/// Reads the XML that junit_report may write (elements and attributes only) and refuses everything else.
class StrictXml {
 public:
  explicit StrictXml(const std::string& text) : text_(text) {
    expect("<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
  }
  Element document() {
    Element root = element();
    space();
    if (at_ != text_.size()) throw std::runtime_error("text after the document");
    return root;
  }

 private:
  void space() {
    while (at_ < text_.size() && std::string(" \n").find(text_[at_]) != std::string::npos) ++at_;
  }
  bool accept(const std::string& word) {
    if (text_.compare(at_, word.size(), word) != 0) return false;
    at_ += word.size();
    return true;
  }
  void expect(const std::string& word) {
    if (!accept(word)) throw std::runtime_error("expected " + word + " at " + text_.substr(at_, 40));
  }
  std::string name() {
    const std::size_t end = text_.find_first_not_of("abcdefghijklmnopqrstuvwxyz", at_);
    if (end == at_ || end == std::string::npos) throw std::runtime_error("expected a name");
    const std::string word = text_.substr(at_, end - at_);
    at_ = end;
    return word;
  }
  std::string value() {
    expect("\"");
    std::string result;
    while (!accept("\"")) {
      if (at_ >= text_.size()) throw std::runtime_error("open attribute");
      if (accept("&amp;"))
        result += '&';
      else if (accept("&lt;"))
        result += '<';
      else if (accept("&gt;"))
        result += '>';
      else if (accept("&quot;"))
        result += '"';
      else if (accept("&apos;"))
        result += '\'';
      else if (accept("&#10;"))
        result += '\n';
      else if (accept("&#9;"))
        result += '\t';
      else if (std::string("&<>").find(text_[at_]) != std::string::npos)
        throw std::runtime_error("not escaped");
      else if (static_cast<unsigned char>(text_[at_]) < ' ')
        throw std::runtime_error("control character");
      else
        result += text_[at_++];
    }
    return result;
  }
  Element element() {
    space();
    expect("<");
    Element result{name(), {}, {}};
    for (space(); !accept("/>"); space()) {
      if (accept(">")) {
        const std::string closing = "</" + result.name + ">";
        for (space(); !accept(closing); space()) result.children.push_back(element());
        return result;
      }
      const std::string attribute = name();
      expect("=");
      if (!result.attributes.emplace(attribute, value()).second) throw std::runtime_error("attribute twice");
    }
    return result;
  }

  std::string text_;
  std::size_t at_ = 0;
};

TEST(Junit, CountsAndNamesWhatFailed) {
  const std::vector<Comparison> comparisons{
      {"letters", {passed_check("scene", "same"), limit_check("force", 2.0, 1.0, "N", "differs by 2 N")}},
      {"collapse", {failed_check("scene", "scene changed"), failed_check("picture", "gone")}}};
  const Element root = StrictXml(junit_report(comparisons)).document();
  EXPECT_EQ(root.name, "testsuites");
  EXPECT_EQ(root.attributes.at("name"), build);
  EXPECT_EQ(root.attributes.at("tests"), "4");
  EXPECT_EQ(root.attributes.at("failures"), "3");
  ASSERT_EQ(root.children.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Element& suite = root.children[i];
    EXPECT_EQ(suite.name, "testsuite");
    EXPECT_EQ(suite.attributes.at("name"), comparisons[i].name);
    EXPECT_EQ(suite.attributes.at("tests"), "2");
    EXPECT_EQ(suite.attributes.at("failures"), std::to_string(comparisons[i].failures()));
    ASSERT_EQ(suite.children.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      const Element& test = suite.children[k];
      const Check& check = comparisons[i].checks[k];
      EXPECT_EQ(test.name, "testcase");
      EXPECT_EQ(test.attributes.at("classname"), comparisons[i].name);
      EXPECT_EQ(test.attributes.at("name"), check.name);
      ASSERT_EQ(test.children.size(), check.passed ? 0u : 1u);
      if (check.passed) continue;
      EXPECT_EQ(test.children[0].name, "failure");
      EXPECT_EQ(test.children[0].attributes.at("message"), check.sentence);
    }
  }
}

TEST(Junit, SaysHowLongEachTookAndHowLongAll) {
  Check run = passed_check("run complete", ""), force = failed_check("force", "no");
  run.seconds = 12.25;
  force.seconds = 0.5;
  const Element root = StrictXml(junit_report({{"letters", {run, force}}, {"collapse", {force}}})).document();
  EXPECT_EQ(root.attributes.at("time"), "13.250");
  EXPECT_EQ(root.children[0].attributes.at("time"), "12.750");
  EXPECT_EQ(root.children[0].children[0].attributes.at("time"), "12.250");
  EXPECT_EQ(root.children[0].children[1].attributes.at("time"), "0.500");
  EXPECT_EQ(root.children[1].attributes.at("time"), "0.500");
}

TEST(Junit, EscapesWhatXmlReserves) {
  const std::string nasty = "a < b && \"c\" > 'd' &amp; ]]>\n\tM\xc3\xbcnchen";
  const Element root = StrictXml(junit_report({{nasty, {failed_check(nasty, nasty)}}})).document();
  const Element& suite = root.children.at(0);
  EXPECT_EQ(suite.attributes.at("name"), nasty);
  EXPECT_EQ(suite.children.at(0).attributes.at("name"), nasty);
  EXPECT_EQ(suite.children.at(0).children.at(0).attributes.at("message"), nasty);
}

TEST(Junit, ReplacesWhatXmlCannotCarry) {
  const Element root = StrictXml(junit_report({{std::string("a\x01\x1b"), {}}})).document();
  EXPECT_EQ(root.children.at(0).attributes.at("name"), "a??");
}

}  // namespace
}  // namespace sandstroke
