// The view `objects`: a colour for each shape and each instance. What several share, such as a mesh, has one in each place.
#include "views/first_surface.glsl"
#include "views/number.glsl"

vec3 color_of_surface(Path path, Surface surface, WaveRay ray) { return color_of_number(surface.instance); }

vec3 color_of_nothing(Path path) { return vec3(0.0); }
