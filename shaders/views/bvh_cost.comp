// The view `bvh-cost`: how many nodes, triangles and instances a camera ray was tested against, as heat: log₂(1 + tests) / 10. A ray
// that meets nothing has its cost too. The tests are where intersect.comp has counted them.
#include "views/first_surface.glsl"
#include "views/heat.glsl"

const float COST_DOUBLINGS = 10.0; // the last colour is 2¹⁰ - 1 tests, and more

vec3 cost_color(Path path) { return heat(log2(1.0 + path.radiance.x) / COST_DOUBLINGS); }

vec3 color_of_surface(Path path, Surface surface, WaveRay ray) { return cost_color(path); }

vec3 color_of_nothing(Path path) { return cost_color(path); }
