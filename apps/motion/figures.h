// Result -> pictures: an animation, plots over time, a page with both, a picture of many instants.
#pragma once
#include "common/page.h"
#include "predict.h"

namespace motion {

study::Animation animation(const Task& task, const Model& model, const Result& result);
/// Torques over their limits, n of [Thesis] (5.3) with its sign: the ten that become largest, and
/// all, ten a plot.
study::Plot torque_plot(const Model& model, const Result& result);
std::vector<study::Plot> torque_plots(const Model& model, const Result& result);
/// Force of each contact, along the world's axes, and the limits that it comes close to.
study::Plot reaction_plot(const Task& task, const Result& result, std::size_t contact);
/// Forces and moments that nothing drives but that would be needed, between frames.
study::Plot balance_plot(const Model& model, const Result& result);
/// The skeleton at equal intervals, from the side and from the front, as SVG.
std::string stroboscope(const Model& model, const Result& result);
study::Page page(const Task& task, const Model& model, const Result& result,
                 const study::Animation& moving);

}  // namespace motion
