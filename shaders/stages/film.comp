// The samples of a wave into the sums of the film: one invocation a pixel. Switch of the variant: SIGNED_FILTER.
#include "stages/film.glsl"
