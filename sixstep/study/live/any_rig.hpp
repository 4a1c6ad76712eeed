// SPDX-License-Identifier: Apache-2.0
// Every firmware in each arithmetic on either kernel, as one value: which runs is decided once.
#pragma once
#include "sixstep/study/live/live_rig.hpp"

namespace sixstep::study::detail {

template <class Scalar>
using LeanRig = LiveRig<rig::LeanDrive<Scalar>>;
template <class Scalar>
using SensedRig = LiveRig<rig::SensedDrive<Scalar>>;
template <class Scalar>
using ProductRig = LiveRig<rig::ProductDrive<Scalar>>;
template <class Scalar>
using SensedOnGeneral = LiveRig<rig::SensedDrive<Scalar>, plant::general::Plant<double>>;
template <class Scalar>
using SensorlessRig = LiveRig<rig::SensorlessDrive<Scalar>>;
template <class Scalar>
using SensorlessOnGeneral = LiveRig<rig::SensorlessDrive<Scalar>, plant::general::Plant<double>>;
template <class Scalar>
using ProductOnGeneral = LiveRig<rig::ProductDrive<Scalar>, plant::general::Plant<double>>;

template <class Scalar>
using FieldRig = LiveRig<rig::FieldDrive<Scalar>>;
template <class Scalar>
using FieldOnGeneral = LiveRig<rig::FieldDrive<Scalar>, plant::general::Plant<double>>;

/// Of a controller of one's own, by what it answers.
template <class Command>
using OwnRig = LiveRig<rig::OwnDrive<Command>>;
template <class Command>
using OwnOnGeneral = LiveRig<rig::OwnDrive<Command>, plant::general::Plant<double>>;
template <template <class> class Live>
using WithEachAnswer = std::variant<Live<control::BridgeCommand<double>>, Live<control::LegCommands<double>>>;

/// A chip that runs a firmware of its own.
using ChipRig = LiveRig<rig::ChipDrive>;
using ChipOnGeneral = LiveRig<rig::ChipDrive, plant::general::Plant<double>>;

/// One firmware on one kernel in each arithmetic.
template <template <class> class Live>
using InEachArithmetic = std::variant<Live<double>, Live<float>, Live<control::Q15>, Live<control::Q14>,
                                      Live<control::Q31>, Live<control::Q30>>;
template <template <class> class Live>
using InFloatingPoint = std::variant<Live<double>, Live<float>>;
template <class... Some>
struct Joined;
template <class... A>
struct Joined<std::variant<A...>> {
  using type = std::variant<A...>;
};
template <class... A, class... B, class... More>
struct Joined<std::variant<A...>, std::variant<B...>, More...> {
  using type = typename Joined<std::variant<A..., B...>, More...>::type;
};

/// On the general kernel the lean firmware is the sensed one whose sensors are ideal: the same bits.
using AnyRig = Joined<InEachArithmetic<LeanRig>, InEachArithmetic<SensedRig>, InEachArithmetic<ProductRig>,
                      InEachArithmetic<SensorlessRig>, InEachArithmetic<SensedOnGeneral>,
                      InEachArithmetic<ProductOnGeneral>, InEachArithmetic<SensorlessOnGeneral>,
                      InFloatingPoint<FieldRig>, InFloatingPoint<FieldOnGeneral>, WithEachAnswer<OwnRig>,
                      WithEachAnswer<OwnOnGeneral>, std::variant<ChipRig, ChipOnGeneral>>::type;

/// The scenario's rig at the start of its run: it pays for what its firmware does, and for nothing else.
/// Problems: the arithmetic cannot hold the drive.
base::Result<AnyRig> made_by(const Scenario& scenario, const Compiled& compiled, rig::Timeline timeline);

}  // namespace sixstep::study::detail
