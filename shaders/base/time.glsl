// The time of a path, in the shutter interval: 0 when it opens, 1 when it closes. All that a path meets is where it is at that
// time. Switch of the variant: HAS_TIME; its kernels set the time before all else.
#ifdef HAS_TIME
float path_time;
#else
const float path_time = 0.0;
#endif
