// The words for the enumerators of physics, as they stand on the wire and in files.
#include "physics/event_log.hpp"
#include "physics/simulator.hpp"
#include "physics/words.hpp"

namespace poolhall::physics {

namespace {

constexpr Words<MotionState, 5> motion_states{{{MotionState::stationary, "stationary"},
                                               {MotionState::spinning, "spinning"},
                                               {MotionState::rolling, "rolling"},
                                               {MotionState::sliding, "sliding"},
                                               {MotionState::pocketed, "pocketed"}}};

constexpr Words<EventType, 6> event_types{{{EventType::cue_strike, "cue_strike"},
                                           {EventType::ball_collision, "ball_collision"},
                                           {EventType::rail_collision, "rail_collision"},
                                           {EventType::pocketed, "pocketed"},
                                           {EventType::transition, "transition"},
                                           {EventType::off_table, "off_table"}}};

constexpr Words<PocketId, 6> pockets{{{PocketId::head_left, "head_left"},
                                      {PocketId::head_right, "head_right"},
                                      {PocketId::side_left, "side_left"},
                                      {PocketId::side_right, "side_right"},
                                      {PocketId::foot_left, "foot_left"},
                                      {PocketId::foot_right, "foot_right"}}};

constexpr Words<RailId, 6> rails{{{RailId::head, "head"},
                                  {RailId::head_left, "head_left"},
                                  {RailId::head_right, "head_right"},
                                  {RailId::foot_left, "foot_left"},
                                  {RailId::foot_right, "foot_right"},
                                  {RailId::foot, "foot"}}};

constexpr Words<Fault, 12> faults{{{Fault::not_finite, "not_finite"},
                                   {Fault::out_of_range, "out_of_range"},
                                   {Fault::overlap, "overlap"},
                                   {Fault::outside_table, "outside_table"},
                                   {Fault::inconsistent_state, "inconsistent_state"},
                                   {Fault::duplicate_ball, "duplicate_ball"},
                                   {Fault::no_cue_ball, "no_cue_ball"},
                                   {Fault::tip_off_ball, "tip_off_ball"},
                                   {Fault::miscue, "miscue"},
                                   {Fault::cue_obstructed, "cue_obstructed"},
                                   {Fault::event_limit, "event_limit"},
                                   {Fault::bad_table, "bad_table"}}};

constexpr Words<Ending, 4> endings{{{Ending::at_rest, "at_rest"},
                                    {Ending::t_max, "t_max"},
                                    {Ending::event_limit, "event_limit"},
                                    {Ending::stopped, "stopped"}}};

constexpr Words<ContactModel, 3> contact_models{{{ContactModel::cluster, "cluster"},
                                                 {ContactModel::sequential, "sequential"},
                                                 {ContactModel::hertz, "hertz"}}};

constexpr Words<RootSolver, 3> root_solvers{
    {{RootSolver::bracketed, "bracketed"},
     {RootSolver::closed_form, "closed_form"},
     {RootSolver::closed_form_polished, "closed_form_polished"}}};

}  // namespace

std::string_view name(MotionState state) {
  return word_of(motion_states, state);
}
std::optional<MotionState> motion_state(std::string_view word) {
  return value_of(motion_states, word);
}

std::string_view name(EventType type) {
  return word_of(event_types, type);
}
std::optional<EventType> event_type(std::string_view word) {
  return value_of(event_types, word);
}

std::string_view name(PocketId pocket) {
  return word_of(pockets, pocket);
}
std::optional<PocketId> pocket_id(std::string_view word) {
  return value_of(pockets, word);
}

std::string_view name(RailId rail) {
  return word_of(rails, rail);
}
std::optional<RailId> rail_id(std::string_view word) {
  return value_of(rails, word);
}

std::string_view name(Fault fault) {
  return word_of(faults, fault);
}

std::string_view name(Ending ending) {
  return word_of(endings, ending);
}

std::string_view name(ContactModel model) {
  return word_of(contact_models, model);
}
std::optional<ContactModel> contact_model(std::string_view word) {
  return value_of(contact_models, word);
}

std::string_view name(RootSolver solver) {
  return word_of(root_solvers, solver);
}
std::optional<RootSolver> root_solver(std::string_view word) {
  return value_of(root_solvers, word);
}

}  // namespace poolhall::physics
