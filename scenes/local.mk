# scenes: what runs from a fresh clone.
EXTRA_DIST += %D%/brighton/scene.yaml %D%/demo/scene.yaml %D%/craig/fleet.sh %D%/craig/sunny.yaml %D%/craig/wet.yaml %D%/craig/median.yaml
.PHONY: demo
demo: all
	@test -f $(srcdir)/%D%/demo/vtest.avi || { echo 'demo: %D%/demo/vtest.avi is missing: ./bootstrap fetches it' >&2; exit 1; }
	@test -f %D%/demo/scene.yaml || { $(MKDIR_P) %D%/demo && cp $(srcdir)/%D%/demo/scene.yaml $(srcdir)/%D%/demo/vtest.avi %D%/demo/; }
	./staffage run %D%/demo/scene.yaml -o out/demo
	@echo 'Look at out/demo/rgb/*.png, and at out/demo/semantic, instance and labels beside them.'
