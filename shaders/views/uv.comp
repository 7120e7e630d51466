// The view `uv`: u and v of the first surface as red and green, without their whole numbers, and a checker of dark blue.
#include "views/first_surface.glsl"

const float CELLS = 8.0; // of the checker, along u and v from 0 to 1
const float CELL_BLUE = 0.25;

vec3 color_of_surface(Path path, Surface surface, WaveRay ray)
{
    vec2 cell = floor(CELLS * surface.uv);
    bool blue = fract(0.5 * (cell.x + cell.y)) > 0.25;
    return vec3(fract(surface.uv), blue ? CELL_BLUE : 0.0);
}

vec3 color_of_nothing(Path path) { return vec3(0.0); }
