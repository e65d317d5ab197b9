"""Other renderers: each is optional, and each module says whether it is here and renders a list of jobs.

The files *_inside.py run in the other renderer's own Python. They read a job list as JSON from their last
argument and print one line "RESULT {json}" for every image; runner.py is their caller.
"""
