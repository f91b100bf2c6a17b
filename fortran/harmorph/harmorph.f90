! What users see of all this.
module harmorph
    use harmorph_constants
    use harmorph_structs
    use harmorph_calls
    use harmorph_outcome, only: hm_abi_version, hm_error, hm_finish, hm_status_name, hm_version
    use harmorph_threads, only: hm_executor, hm_openmp, hm_progress, hm_run, hm_tasks
    use harmorph_mesh, only: hm_mesh
    use harmorph_curve_set, only: hm_curve
    use harmorph_curves, only: hm_curves, hm_fit_words
    use harmorph_problem, only: hm_condition, hm_options
    use harmorph_analysis, only: hm_analysis_words
    use harmorph_basis_info, only: hm_basis_info
    use harmorph_basis, only: hm_basis
    use harmorph_plan_core, only: hm_safe_options
    use harmorph_plan, only: hm_plan
    implicit none
    public
end module
