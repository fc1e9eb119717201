# docs
dist_doc_DATA = %D%/labels.md %D%/materials.md %D%/scene.md
