// Written by src/layout; do not edit. The only lines with binding numbers.
#include "shared/layout.glsl"
#include "shared/fetch.glsl"

layout(std140, set = 0, binding = 0) uniform FrameBlock { Frame frame; };
READ_WORDS(1, 33, Words_tree, words_tree, texels_tree, fetch_tree)
READ_WRITE_WORDS(2, 34, Words_schedule, words_schedule, texels_schedule, fetch_schedule, store_schedule)
READ_WORDS(3, 35, Words_instances, words_instances, texels_instances, fetch_instances)
READ_WORDS(4, 36, Words_faces, words_faces, texels_faces, fetch_faces)
READ_WORDS(5, 37, Words_vertices, words_vertices, texels_vertices, fetch_vertices)
READ_WORDS(6, 38, Words_materials, words_materials, texels_materials, fetch_materials)
READ_WORDS(7, 39, Words_textures, words_textures, texels_textures, fetch_textures)
READ_WORDS(8, 40, Words_texels, words_texels, texels_texels, fetch_texels)
READ_WORDS(9, 41, Words_lights, words_lights, texels_lights, fetch_lights)
READ_WORDS(10, 42, Words_environment, words_environment, texels_environment, fetch_environment)
READ_WRITE_WORDS(11, 43, Words_rays, words_rays, texels_rays, fetch_rays, store_rays)
READ_WRITE_WORDS(12, 44, Words_hits, words_hits, texels_hits, fetch_hits, store_hits)
READ_WRITE_WORDS(13, 45, Words_paths, words_paths, texels_paths, fetch_paths, store_paths)
READ_WRITE_WORDS(14, 46, Words_shadows, words_shadows, texels_shadows, fetch_shadows, store_shadows)
READ_WRITE_WORDS(15, 47, Words_aovs, words_aovs, texels_aovs, fetch_aovs, store_aovs)
layout(std430, set = 0, binding = 16) buffer Uints_queue { uint queue[]; };
layout(std430, set = 0, binding = 17) buffer Uints_counters { uint counters[]; };
layout(std430, set = 0, binding = 18) buffer Uints_film { uint film[]; };
layout(std430, set = 0, binding = 19) buffer Uints_parked { uint parked[]; };
READ_WORDS(20, 52, Words_points, words_points, texels_points, fetch_points)
READ_WRITE_WORDS(21, 53, Words_values, words_values, texels_values, fetch_values, store_values)
READ_WORDS(22, 54, Words_lens, words_lens, texels_lens, fetch_lens)
READ_WORDS(23, 55, Words_details, words_details, texels_details, fetch_details)
