#!/usr/bin/env python3
"""Small faults in the mathematics, each of which a test must find: a sign, a factor, an index.

Run it in a clone of its own, whose sources it changes and restores: tests/mutations.py build contact/
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys

MUTATIONS = [  # file, what stands there, the fault
    ('contact/active_set', 'next[i] = pressure(i) >= least_pressure', 'next[i] = pressure(i) <= least_pressure'),
    ('contact/active_set', 'next[i] = gap(i) < least_gap', 'next[i] = gap(i) < 0.01'),
    ('contact/active_set', 'keep_first_change(solution.active, next);', ';'),
    ('contact/contact_problem', 'loads.vertical += force(i) * std::cos', 'loads.vertical += force(i) * std::sin'),
    ('contact/contact_problem', 'pressure(i) /= weight(i)', 'pressure(i) *= weight(i)'),
    ('contact/contact_patch', 'std::pow(d, 1 + s)', 'std::pow(d, 1 - s)'),
    ('contact/contact_patch', 'std::pow(d, 1 - s)', 'std::pow(d, 1 + s)'),
    ('contact/contact_patch', 'pressure_at(distance(inner) + first)', 'pressure_at(distance(inner) + last)'),
    ('contact/contact_patch', '? p / (p + g)', '? g / (p + g)'),
    ('contact/contact_patch', 'edge - nodes.shift(near)', 'edge'),
    ('contact/contact_patch', '1. / 3 : 1. / 5', '1. / 5 : 1. / 3'),
    ('contact/contact_patch', 'lowest_point - road.tangent_angle()', 'lowest_point + road.tangent_angle()'),
    ('contact/contact_patch', 'by_pressure && by_gap ? 0.2 : 0.5', '0.'),
    ('contact/contact_patch', 'return roughest + ', 'return '),
    ('contact/contact_patch', 'one.is_cut ? one.edge : one.uncertainty', '0'),
    ('contact/contact_patch', '1. / 3 : 1. / 2', '1. / 2 : 1. / 3'),
    ('contact/load_control', '(*near.work_conjugate - *far.work_conjugate)', '(*far.work_conjugate - *near.work_conjugate)'),
    ('contact/load_control', '*stiffness.work_conjugate -=', '*stiffness.work_conjugate +='),
    ('base/falling_zero', 'value > 0 ? std::min(x + step, limit)', 'value < 0 ? std::min(x + step, limit)'),
    ('contact/uzawa', 'p(i) - rho * (displacement(i) - problem.phi(i))', 'p(i) + rho * (displacement(i) - problem.phi(i))'),
    ('contact/uzawa', 'length.rho >= *length.largest', 'false'),
    ('error_bound/error_bound', 'error.eta * error.eta / 2 -', 'error.eta * error.eta -'),
    ('error_bound/error_bound', 'error_of_v = error.eta + delta', 'error_of_v = error.eta'),
    ('error_bound/error_bound', 'return eta * std::cos(low) + moved', 'return eta * std::cos(low)'),
    ('error_bound/error_bound', 'error.energy_norm / smallest_norm', 'error.energy_norm / norm'),
    ('error_bound/error_bound', 'integrals.bound_squared + integrals.gap_work', 'integrals.bound_squared'),
    ('error_bound/error_bound', '/ 2 + 2 * delta', '/ 2'),
    ('error_bound/error_bound', 'loads.total.lower = std::max(loads.total.lower, 0.)', ''),
    ('error_bound/certificate_integrals', 'q_h_here - psi_z - r * v_r', 'q_h_here + psi_z - r * v_r'),
    ('error_bound/certificate_integrals', 'const double z_part = psi_s + v_z', 'const double z_part = psi_s - v_z'),
    ('error_bound/certificate_integrals', 'here.gap_work = 2 * pressure', 'here.gap_work = pressure'),
    ('error_bound/certificate_integrals', 'u[i] - fields.discrete(of_cell[i])', '0'),
    ('error_bound/certificate_integrals', 'moved_slopes(q, correction_r, correction_z)', 'moved_slopes(q, 0, correction_z)'),
    ('error_bound/certificate_integrals', 'here.loads[k].trace = v * w', 'here.loads[k].trace = v'),
    ('error_bound/certificate_integrals', 'here.loads[k].pressure = pressure * w', 'here.loads[k].pressure = 0'),
    ('error_bound/certificate_integrals', '(*slopes)[k][q] * w[k]', '(*slopes)[k][q]'),
    ('error_bound/load_bounds', 'std::cos(k * from_lowest_point(z))', 'std::cos(k * z)'),
    ('error_bound/load_bounds', 'k == 0 ? 2 * PI : PI', 'PI'),
    ('error_bound/load_bounds', 'integrals.trace + pressure) / 2', 'integrals.trace - pressure) / 2'),
    ('error_bound/load_bounds', 'integrals.work_of_force - w.flux()', 'integrals.work_of_force + w.flux()'),
    ('error_bound/admissible_displacement', 'return {-above, -slope, limit_to_road};', 'return {-above, slope, limit_to_road};'),
    ('error_bound/admissible_displacement', 'return {0, 0, limit_to_road - above};', 'return {0, 0, limit_to_road};'),
    ('error_bound/admissible_displacement', 'begins_before ? 0', 'begins_before ? 1'),
    ('error_bound/admissible_pressure', 'std::clamp(edge.slope, -2 * edge.mean, 2 * edge.mean)', 'std::clamp(edge.slope, -3 * edge.mean, 3 * edge.mean)'),
    ('error_bound/admissible_pressure', 'edge_pressures[from] = {0, 0};', ';'),
    ('error_bound/force_integral', 'f * (b - r) * (b + r) / 2', 'f * (b - r) * (b + r)'),
    ('error_bound/dual_system', 'mean - slope * (1 - t) / 2', 'mean + slope * (1 - t) / 2'),
    ('exact/exact_solution', 'solution.norm_squared / 2 - work_of_f', 'solution.norm_squared / 2 + work_of_f'),
    ('exact/exact_solution', 'work_of_f - pressure_times_road', 'work_of_f + pressure_times_road'),
    ('exact/exact_solution', 'work_of_f_alone - scene', 'work_of_f_alone + scene'),
    ('exact/galerkin_pressure', 'free - road.displacement(x)', 'road.displacement(x) - free'),
    ('exact/galerkin_pressure', 'std::pow(k * w, -2 * nu - 1)', 'std::pow(k * w, -2 * nu)'),
    ('exact/galerkin_pressure', 'j == 0 ? 1 : 2', '2'),
    ('exact/bessel_modes', 'return k - x * x /', 'return k + x * x /'),
    ('exact/bessel_modes', '+ 1 / (g * q)) / r', '+ 1 / g) / r'),
    ('solver/assembly', 'r * alpha * phi[1]', 'alpha * phi[1]'),
    ('solver/condensed_system', 'schur(unknowns.n_inner + k, unknowns.n_inner + k) -= shift(k)', ';'),
    ('solver/condensed_system', 'matrix(i, j) = -schur', 'matrix(i, j) = schur'),
    ('solver/condensed_system', 'holds_on_all(processes, is_own_known)', 'is_own_known'),
    ('solver/sparse_factor', 'products[i] -= added(k)', 'products[i] -= 0'),
    ('solver/interface_solver', '!is_given[i] && !is_given[j]', 'true'),
    ('solver/elimination_order', 'number.local_element(i) > 1', 'number.local_element(i) > 2'),
    ('solver/contact_equations', 'load(k) -= state.force', 'load(k) += state.force'),
    ('solver/contact_equations', 'else if (kept.is_own(k))', 'else'),
    ('solver/contact_equations', 'solve(pinned, Vector<double>(), change)', 'solve(pinned, g, change)'),
    ('solver/cholmod_factor', 'schur_factor().Tvmult(y_c', 'schur_factor().vmult(y_c'),
    ('solver/cholmod_factor', 'schur_factor().vmult(condensed', 'schur_factor().Tvmult(condensed'),
    ('mesh/nested_dissection', 'lowest < highest && box.low[direction] < middle && middle < box.high[direction]', 'lowest < highest'),
    ('mesh/nested_dissection', '(below == 0) != (above == 0)', 'on == 0 && (below == 0) != (above == 0)'),
    ('mesh/ring_space', 'space.outer_radius() * length * rule.weight(k)', 'length * rule.weight(k)'),
    ('mesh/ring_mesh', 'holds_an_end(cell, scene.zone_end)', 'holds_an_end(cell, scene.zone_begin)'),
    ('mesh/contact_boundary', 'first = begin - surface.begin()', 'first = 0'),
    ('adapt/marking', 'std::max(low, least_indicator * largest)', 'low'),
    ('adapt/marking', 'fixed > (goal > 0 ? goal * goal * all : reducible)', 'fixed > 0'),
    ('run/simulation', 'options.mesh.wanted_relative_error / certificate->error.relative', '0'),
    ('run/solve_on_mesh', 'norm_squared / 2 - work_of_force', 'norm_squared / 2 + work_of_force'),
    ('run/simulation', 'run.cycles.size() > most_refinements', 'run.cycles.size() >= most_refinements'),
    ('study/study_solver', 'one.cylinder.radial_force == other.cylinder.radial_force &&', ''),
]
# The tests that find most faults of a module run first.
TESTS_OF = {'contact': 'ContactPatch*:ActiveSet*:Uzawa*:Drum*:Patches*:FullContact*:Load.*',
            'base': 'FallingZero*:Load.*',
            'error_bound': 'AdmissiblePressure.*:ForceIntegral*:LoadBounds.*:Certificate.*',
            'exact': 'Bessel*:Gegenbauer*:ExactSolution*:FindExactSolution*',
            'solver': '*Condensation*:CholmodFactor*:FullContact*:Sweep.*:Stiffness*',
            'mesh': '*Space*:NestedDissection*:FirstMesh*:ContactPatch*:FullContact*',
            'adapt': 'Marking*:Refinement*',
            'run': 'Simulation*:LeaveOut*:FullContact*',
            'study': 'Sweep*:RepeatedStudy*'}
ALL_TESTS = ('ContactPatch*:Drum*:Patches*:ActiveSet*:Uzawa*:PaperFigure*:Stiffness*:Load.*:Road.*:FullContact*:Contact*:'
             '*Space*:*Condensation*:CholmodFactor*:LeaveOut*:Sweep*:Marking*:Certificate.*:LoadBounds.*:'
             'AdmissiblePressure.*:ForceIntegral*:Stability.*:ExactSolution*:Bessel*:Gegenbauer*:ManufacturedScene*:'
             'TrueErrors*:Random*')

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
arguments.add_argument('build', type=pathlib.Path, help='the directory of the build')
arguments.add_argument('files', nargs='?', default='', type=re.compile, help='a regular expression of files')
arguments = arguments.parse_args()
build, files = arguments.build.resolve(), arguments.files
root = pathlib.Path(__file__).resolve().parent.parent
os.environ['OPENBLAS_NUM_THREADS'] = '1'


def first_failure(module):
    """The name of a test that fails, or how the tests ended; empty if all pass."""
    of_module, of_all = (['timeout', '600', build / 'tests/rollwave_tests', '--gtest_brief=1', '--gtest_fail_fast',
                          f'--gtest_filter={tests}'] for tests in (TESTS_OF[module], ALL_TESTS))
    of_processes = ['ctest', '--test-dir', build, '-R', 'substructures', '-V', '--timeout', '30']
    for command in (of_module, of_processes, of_all):
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode != 0:
            failed = re.findall(r'FAILED  \] (\S+)', run.stdout)
            return failed[0] if failed else f'exit code {run.returncode}'
    return ''


survivors = 0
for name, right, wrong in MUTATIONS:
    if not files.search(name):
        continue
    path = root / f'source/{name}.cc'
    original = path.read_text()
    if right not in original:
        print(f'NOT THERE   {name}: {right}', flush=True)
        survivors += 1
        continue
    path.write_text(original.replace(right, wrong, 1))
    try:
        built = subprocess.run(['cmake', '--build', build, '--target', 'rollwave_tests'], capture_output=True)
        failure = first_failure(name.split('/')[0]) if built.returncode == 0 else ''
    finally:
        path.write_text(original)
    survivors += failure == ''
    verdict = 'not built' if built.returncode != 0 else 'caught' if failure else 'SURVIVED'
    print(f'{verdict:9}   {name}: {wrong}    {failure}', flush=True)
sys.exit(survivors > 0)
