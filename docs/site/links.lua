-- Links between documents, as they stand for readers of the repository, lead to the pages made of them.
function Link(link)
  if not link.target:match("^%a+:") then
    link.target = link.target:gsub("README%.md", "index.html"):gsub("%.md", ".html")
  end
  return link
end
