#include "core/hershey_text.h"

extern "C" {  // the header has no C++ guard of its own
#include <hersheyfont.h>
}

#include <memory>
#include <string>

#include "core/error.h"

namespace sandstroke {

SingleStrokeText hershey_text(std::string_view text, std::string_view font_name) {
  constexpr double capital_height = 21.0;  // the library's units: y up from the base line
  const std::string name(font_name);
  // The library joins the name to its font folder: only a plain name stays inside that.
  if (name.empty() || name.find('/') != std::string::npos)
    throw_input_error("font '{}' is not a font name; take one of /usr/share/hershey-fonts, such as futural",
                      name);
  const std::unique_ptr<hershey_font, void (*)(hershey_font*)> font(hershey_font_load(name.c_str()),
                                                                    hershey_font_free);
  if (!font)
    throw_input_error("font '{}' is not installed; take one of /usr/share/hershey-fonts, such as futural",
                      name);

  SingleStrokeText drawn;
  for (const char letter : text) {
    const hershey_glyph* glyph = hershey_font_glyph(font.get(), static_cast<unsigned char>(letter));
    if (!glyph || (glyph->width == 0 && glyph->npaths == 0))
      throw_input_error("font '{}' has no letter of code {}; write the text with ASCII letters", name,
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

}  // namespace sandstroke
