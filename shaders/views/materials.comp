// The view `materials`: a colour for each material. A mix has one, and not those of its parts.
#include "views/first_surface.glsl"
#include "views/number.glsl"

vec3 color_of_surface(Path path, Surface surface, WaveRay ray) { return color_of_number(surface.material); }

vec3 color_of_nothing(Path path) { return vec3(0.0); }
