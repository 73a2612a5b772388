#include "validation/stress/stress_report.h"

#include <algorithm>

#include "core/asset.h"
#include "report/page.h"

SANDSTROKE_DECLARE_ASSET(stress);
SANDSTROKE_DECLARE_ASSET(stress_margins);

namespace sandstroke {

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::stable:
      return "stable";
    case Verdict::limit_cycle:
      return "limit cycle";
    case Verdict::diverged:
      return "diverged";
    case Verdict::refused:
      return "refused";
    case Verdict::not_converged:
      return "not converged";
    case Verdict::broken:
      return "broken";
  }
  return "";
}

bool is_among(Verdict verdict, const std::vector<Verdict>& expected) {
  return std::find(expected.begin(), expected.end(), verdict) != expected.end();
}

bool StressCase::surprise() const { return !is_among(verdict, expected); }

int StressReport::surprises() const {
  auto count =
      std::count_if(cases.begin(), cases.end(), [](const StressCase& one) { return one.surprise(); });
  for (const StabilityMap& map : maps)
    for (const std::vector<bool>& row : map.surprise) count += std::count(row.begin(), row.end(), true);
  return static_cast<int>(count);
}

nlohmann::ordered_json as_json(const StressReport& report) {
  using Json = nlohmann::ordered_json;
  const auto axis = [](const MapAxis& a) {
    return Json{{"name", a.name}, {"unit", a.unit}, {"logarithmic", a.logarithmic}, {"values", a.values}};
  };
  Json json{{"surprises", report.surprises()}, {"margins", Json::array()},    {"cases", Json::array()},
            {"maps", Json::array()},           {"boundaries", Json::array()}, {"traces", Json::array()}};
  for (const LoopMargins& loop : report.margins) {
    Json margins = Json::array();
    for (const Margin& one : loop.margins)
      margins.push_back({{"what", one.what},
                         {"unit", one.unit},
                         {"value", one.value},
                         {"boundary", one.boundary},
                         {"factor", one.factor}});
    json["margins"].push_back({{"name", loop.name},
                               {"settings", loop.settings},
                               {"stable", loop.stable},
                               {"margins", std::move(margins)}});
  }
  for (const StressCase& one : report.cases) {
    Json expected = Json::array();
    for (const Verdict verdict : one.expected) expected.push_back(name_of(verdict));
    json["cases"].push_back({{"group", one.group},
                             {"name", one.name},
                             {"settings", one.settings},
                             {"verdict", name_of(one.verdict)},
                             {"expected", expected},
                             {"surprise", one.surprise()},
                             {"detail", one.detail}});
  }
  for (const StabilityMap& map : report.maps) {
    Json verdicts = Json::array(), surprises = Json::array(), curves = Json::array(), marks = Json::array();
    for (const auto& row : map.verdict) {
      Json names = Json::array();
      for (const Verdict verdict : row) names.push_back(name_of(verdict));
      verdicts.push_back(names);
    }
    for (const auto& row : map.surprise) surprises.push_back(row);
    for (const MapCurve& curve : map.curves) {
      Json points = Json::array();
      for (const auto& [x, y] : curve.points) points.push_back({x, y});
      curves.push_back({{"name", curve.name}, {"points", points}});
    }
    for (const MapMark& mark : map.marks)
      marks.push_back(
          {{"name", mark.name}, {"x", mark.x}, {"y", mark.y}, {"same", mark.same}, {"stable", mark.stable}});
    json["maps"].push_back({{"name", map.name},
                            {"title", map.title},
                            {"text", map.text},
                            {"x", axis(map.x)},
                            {"y", axis(map.y)},
                            {"verdict", verdicts},
                            {"surprise", surprises},
                            {"curves", curves},
                            {"marks", marks}});
  }
  for (const Boundary& b : report.boundaries)
    json["boundaries"].push_back(
        {{"settings", b.settings}, {"measured", b.measured}, {"exact", b.exact}, {"passive", b.passive}});
  for (const StressTrace& trace : report.traces) {
    Json series = Json::array();
    for (const auto& [name, values] : trace.series) series.push_back({{"name", name}, {"values", values}});
    json["traces"].push_back({{"name", trace.name},
                              {"title", trace.title},
                              {"text", trace.text},
                              {"y_name", trace.y_name},
                              {"time", trace.time},
                              {"series", series}});
  }
  return json;
}

std::string stress_page(const nlohmann::ordered_json& data) {
  return html_page("sandstroke stress: numerical stability",
                   {.scripts = {SANDSTROKE_ASSET(stress_margins), SANDSTROKE_ASSET(stress)}}, data);
}

}  // namespace sandstroke
