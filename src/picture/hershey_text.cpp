#include "picture/hershey_text.h"

extern "C" {  // the header has no C++ guard of its own
#include <hersheyfont.h>
}

#include "core/error.h"

namespace sandstroke {

HersheyFont::HersheyFont(std::string_view name) : name_(name), font_(nullptr, hershey_font_free) {
  // The library joins the name to its font folder: only a plain name stays inside that.
  if (name_.empty() || name_.find('/') != std::string::npos)
    throw_input_error("font '{}' is not a font name; take one of /usr/share/hershey-fonts, such as futural",
                      name_);
  font_.reset(hershey_font_load(name_.c_str()));
  if (!font_)
    throw_input_error("font '{}' is not installed; take one of /usr/share/hershey-fonts, such as futural",
                      name_);
}

SingleStrokeText HersheyFont::draw(std::string_view text) const {
  constexpr double capital_height = 21.0;  // the library's units: y up from the base line
  SingleStrokeText drawn;
  for (const char letter : text) {
    const hershey_glyph* glyph = hershey_font_glyph(font_.get(), static_cast<unsigned char>(letter));
    if (!glyph || (glyph->width == 0 && glyph->npaths == 0))
      throw_input_error("font '{}' has no letter of code {}; write the text with ASCII letters", name_,
                        static_cast<int>(static_cast<unsigned char>(letter)));
    for (const hershey_path* path = glyph->paths; path; path = path->next) {
      std::vector<Eigen::Vector2d> line;
      for (int i = 0; i < path->nverts; ++i) {
        line.emplace_back(drawn.width + path->verts[i].x / capital_height, path->verts[i].y / capital_height);
      }
      if (!line.empty()) drawn.polylines.push_back(std::move(line));
    }
    drawn.width += glyph->width / capital_height;
  }
  return drawn;
}

SingleStrokeText hershey_text(std::string_view text, std::string_view font) {
  return HersheyFont(font).draw(text);
}

}  // namespace sandstroke
