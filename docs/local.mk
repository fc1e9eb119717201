# docs
dist_doc_DATA = %D%/cast.md %D%/fidelity.md %D%/import.md %D%/labels.md %D%/light.md %D%/materials.md %D%/models.md %D%/optics.md %D%/performance.md %D%/roads.md %D%/scene.md %D%/traffic.md
EXTRA_DIST += %D%/demo.jpg %D%/models.jpg %D%/fidelity.jpg
