#include "physics/simulator.hpp"

#include "physics/simulator_impl.hpp"

namespace poolhall::physics {

template class EventLoop<double>;
template class EventLoop<double, Guarded>;
template class EventLoop<double, Precise>;
template class EventLoop<long double>;

template Expected<void> check_scene(const Scene<double>&);
template Expected<void> check_scene(const Scene<long double>&);
template Expected<Simulation<double>> simulate(const Scene<double>&, const SimulationOptions&);
template Expected<Simulation<long double>> simulate(const Scene<long double>&,
                                                    const SimulationOptions&);

}  // namespace poolhall::physics
