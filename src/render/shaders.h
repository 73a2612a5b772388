#pragma once

#include <string>

namespace sandstroke::shaders {

// The sources of the vertex and fragment shaders, OpenGL 3.3 core. `world` is a position in bed coordinates
// [m]. The tool takes sky from points up to this distance, in its radii.
inline constexpr double tool_reach = 8.0;
std::string surface_vertex();              ///< a tile: heights from a texture
std::string solid_vertex();                ///< the box and the tool: vertices times `scale` plus `offset`
std::string surroundings_vertex();         ///< one triangle over the whole picture
std::string sand_fragment(bool on_floor);  ///< on_floor: the bed has a floor, which is seen where it is bare
std::string map_fragment(bool on_floor);
std::string box_fragment();
std::string tool_fragment();
std::string surroundings_fragment();

}  // namespace sandstroke::shaders
