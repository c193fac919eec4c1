// Decides what a post hides from an eye.
#pragma once

#include "im/filter.h"
#include "im/view/sector.h"

namespace rink::im {

/// True if `post` alone hides all of `box` from `eye`: the straight way from it to every point of
/// the box passes through the inside of the post. A way that only touches the post is free, and a
/// post that the eye is in hides nothing. What is hidden is convex, so the four corners decide. All
/// is plain.
bool hides(const Disc& post, const Eye& eye, const Region& box);
/// How far the eye and the box may come before that can change [m], by doubles: above 0 if it hides
/// all, below if not, 0 if that is in doubt.
double shadow_clearance(const Disc& post, const Eye& eye, const Region& box);
/// True if the point, which is plain, is inside the post; its rim is not.
bool holds(const Disc& post, double x, double y);

}  // namespace rink::im
