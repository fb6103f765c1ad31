"""The problems of rddlrepository 2.2, by the instances that they have: for their ids where it is not installed."""

from __future__ import annotations

_INSTANCES = {
    (1, 10): """AcademicAdvising_MDP_ippc2014 AcademicAdvising_POMDP_ippc2014 CooperativeRecon_MDP_ippc2011
        CooperativeRecon_POMDP_ippc2011 CrossingTraffic_MDP_ippc2011 CrossingTraffic_MDP_ippc2014
        CrossingTraffic_POMDP_ippc2011 CrossingTraffic_POMDP_ippc2014 Elevators_MDP_ippc2011 Elevators_MDP_ippc2014
        Elevators_POMDP_ippc2011 Elevators_POMDP_ippc2014 GameOfLife_MDP_ippc2011 GameOfLife_POMDP_ippc2011
        Navigation_MDP_ippc2011 Navigation_POMDP_ippc2011 SkillTeaching_MDP_ippc2011 SkillTeaching_MDP_ippc2014
        SkillTeaching_POMDP_ippc2011 SkillTeaching_POMDP_ippc2014 SysAdmin_MDP_ippc2011 SysAdmin_POMDP_ippc2011
        Tamarisk_MDP_ippc2014 Tamarisk_POMDP_ippc2014 Traffic_CTM_MDP_ippc2011 Traffic_CTM_POMDP_ippc2011
        Traffic_MDP_ippc2014 Traffic_POMDP_ippc2014 TriangleTireworld_MDP_ippc2014 TriangleTireworld_POMDP_ippc2014
        Wildfire_MDP_ippc2014 Wildfire_POMDP_ippc2014""",
    (1, 20): """AcademicAdvising_ippc2018 ChromaticDice_ippc2018 CooperativeRecon_ippc2018 EarthObservation_ippc2018
        Manufacturer_ippc2018 PushYourLuck_ippc2018 RedFinnedBlueEye_ippc2018""",
    (0, 0): """Acrobot_gym Bicycle_physics BinPacking_or Blackjack_arcade CartPole_Continuous_gym CartPole_Discrete_gym
        ComplexSysAdmin_rddlsim Epidemic Intruders_Continuous Intruders_Discrete Knapsack_or Logistics_rddlsim
        MountainCar_Continuous_gym MountainCar_Discrete_gym Navigation_Continuous Pendulum_gym Pizza_rddlsim Pong_arcade
        PowerGen_Continuous PowerGen_Discrete PropDBN_rddlsim Sokoban_arcade SupplyChain_or TSP_or Tetris_arcade
        TowerOfHanoi_arcade TrafficBLX_ComplexPhases TrafficBLX_SimplePhases UAV_Discrete UAV_Mixed Workforce_rddlsim""",
    (0, 1): """Eight_arcade Elevators HVAC Option_or Quadcopter_physics Reacher_physics Reservoir_Continuous
        Reservoir_Discrete Sidewalk_rddlsim Sudoku_arcade UAV_Continuous""",
    (0, 3): "Zombies_arcade",
    (0, 5): "MarsRover_ippc2023",
    (0, 6): "RaceCar_ippc2023",
    (0, 7): "HVAC_ippc2023 RecSim_ippc2023",
    (1, 5): "MountainCar_ippc2023 PowerGen_ippc2023 Reservoir_ippc2023 UAV_ippc2023",
} | {(place, place): f"WildlifePreserve_p{place}_ippc2018" for place in range(1, 21)}


def known_instances() -> list[tuple[str, str]]:
    """Problems and instances."""
    return [
        (name, str(instance))
        for (first, last), names in _INSTANCES.items()
        for name in names.split()
        for instance in range(first, last + 1)
    ]
