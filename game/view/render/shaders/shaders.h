// The sources of all shaders (GLSL 3.30): light and table shared by all, the standing scene, marks
// that lie on the table, pieces in perspective, pieces from above, overlays.
#pragma once

namespace rink::view {

extern const char* const light_source;  ///< before all others: light, hall and table
extern const char* const stage_vertex;
extern const char* const stage_fragment;
extern const char* const mark_vertex;
extern const char* const mark_fragment;
extern const char* const piece_vertex;
extern const char* const piece_fragment;
extern const char* const overlay_vertex;
extern const char* const overlay_fragment;
extern const char* const point_vertex;
extern const char* const point_fragment;
extern const char* const flat_vertex;
extern const char* const flat_fragment;
extern const char* const plan_vertex;
extern const char* const plan_fragment;

}  // namespace rink::view
