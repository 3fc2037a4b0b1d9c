(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Triangles joined like a tree: t of them, connected, with t + 2 sides that are not shared. These are one cycle. So a
   tied polygon [TIE-3] is known by counting its sides and vertices. *)
From Coq Require Import Reals Lra Lia List Permutation Classical.
From Dyadel Require Import Plane Distance Cells Legal Nerve Orientation Path TiedRim Winding TiedPolygon.
Open Scope R_scope.

(* ---- walks ---- *)

(* From a to z, side by side. *)
Fixpoint walk (a : nat) (E : list (nat * nat)) (z : nat) : Prop :=
  match E with nil => a = z | (x, y) :: F => x = a /\ walk y F z end.

Lemma walk_app a E F z : walk a (E ++ F) z <-> exists m, walk a E m /\ walk m F z.
Proof.
  revert a. induction E as [| [x y] E IH]; intros a; simpl.
  - split; [intros W; now exists a | intros [m [-> W]]; exact W].
  - rewrite IH. split; [intros [Q [m [U V]]]; now exists m | intros [m [[Q U] V]]; split; [exact Q | now exists m]].
Qed.

Lemma walk_forward (P : nat -> nat -> Prop) E : (forall a b c, In (a, b) E -> In (b, c) E -> P a b -> P b c) ->
  forall F x y z, walk y F z -> incl F E -> In (x, y) E -> P x y -> forall u v, In (u, v) F -> P u v.
Proof.
  intros Step. induction F as [| [c w] F IH]; intros x y z W S X Q u v G; [destruct G |].
  destruct W as [-> W]. assert (Y : In (y, w) E) by (apply S; now left).
  assert (K : P y w) by (now apply (Step x)).
  destruct G as [G | G]; [injection G as <- <-; exact K |].
  apply (IH y w z W); auto. intros e H. apply S. now right.
Qed.

Lemma walk_one_cycle a E : walk a E a -> one_cycle E.
Proof.
  intros W P Step x y u v F G Q. apply in_split in F as [E1 [E2 H]].
  rewrite H in W. apply walk_app in W as [m [W1 [<- W2]]].
  assert (Round : walk y (E2 ++ E1) x) by (apply walk_app; now exists a).
  assert (Other : In (u, v) (E2 ++ E1) -> P u v).
  { apply (walk_forward P E Step _ x y x Round); [| rewrite H; apply in_elt | exact Q].
    intros e K. rewrite H. apply in_app_or in K as [K | K]; apply in_or_app; [right; now right | now left]. }
  rewrite H in G. apply in_app_or in G as [G | [G | G]].
  - apply Other, in_or_app. now right.
  - injection G as <- <-. exact Q.
  - apply Other, in_or_app. now left.
Qed.

(* ---- lists ---- *)

Lemma nodup_apart {A} (l m : list A) x : NoDup (l ++ m) -> In x l -> ~ In x m.
Proof.
  induction l as [| y l IH]; intros D X; [destruct X |]. simpl in D. inversion D as [| ? ? N D']; subst.
  destruct X as [-> | X]; [intros M; apply N, in_or_app; now right | now apply IH].
Qed.

Lemma nodup_right {A} (l m : list A) : NoDup (l ++ m) -> NoDup m.
Proof. induction l as [| y l IH]; intros D; [exact D |]. simpl in D. inversion D; subst. now apply IH. Qed.

Lemma nodup_left {A} (l m : list A) : NoDup (l ++ m) -> NoDup l.
Proof. intros D. apply nodup_right with m, (Permutation_NoDup (Permutation_app_comm l m)), D. Qed.

Lemma one_way_out (E : list (nat * nat)) x y z : NoDup (map fst E) -> In (x, y) E -> In (x, z) E -> y = z.
Proof.
  induction E as [| [u v] E IH]; simpl; intros D F G; [destruct F |]. inversion D as [| ? ? N D']; subst.
  destruct F as [F | F], G as [G | G]; try congruence; [| | now apply IH]; exfalso; apply N.
  - injection F as -> ->. change x with (fst (x, z)). now apply in_map.
  - injection G as -> ->. change x with (fst (x, y)). now apply in_map.
Qed.

Lemma both_back a b J : In (a, b) (flat_map both J) -> In (b, a) (flat_map both J).
Proof.
  intros F. apply in_flat_map in F as [[x y] [G F]]. apply in_flat_map. exists (x, y). split; [exact G |].
  simpl in *. destruct F as [F | [F | []]]; injection F as <- <-; auto.
Qed.

Lemma turned_to t a b : In (b, a) (sides t) -> exists c, Permutation (sides t) ((b, a) :: (a, c) :: (c, b) :: nil).
Proof.
  destruct t as [[x y] z]. simpl. intros [F | [F | [F | []]]]; injection F as <- <-.
  - now exists z.
  - exists x. apply (Permutation_cons_append ((y, z) :: (z, x) :: nil) (x, y)).
  - exists y. symmetry. apply (Permutation_cons_append ((x, y) :: (y, z) :: nil) (z, x)).
Qed.

Lemma sides_permuted T1 T2 : Permutation T1 T2 -> Permutation (flat_map sides T1) (flat_map sides T2).
Proof. intros P. now apply Permutation_flat_map. Qed.

Definition pair_dec (x y : nat * nat) : {x = y} + {x <> y}.
Proof. decide equality; apply Nat.eq_dec. Qed.

(* ---- growing the tree ---- *)

(* No part of the triangles is separate: from any part of them to the others there is a pair of I. *)
Definition joined (T : list (nat * nat * nat)) (I : list (nat * nat)) : Prop := forall T1 T2,
  Permutation T (T1 ++ T2) -> T1 <> nil -> T2 <> nil ->
  exists a b, In (a, b) (flat_map both I) /\ In (a, b) (flat_map sides T1) /\ In (b, a) (flat_map sides T2).

Section Tree.
(* T: triangles, no half-edge of which is in two of them; E: their sides that are not shared; I: the shared sides. *)
Variables (T : list (nat * nat * nat)) (E I : list (nat * nat)).
Variable once : NoDup (flat_map sides T).
Variable rim : Permutation (flat_map sides T) (E ++ flat_map both I).
Variable connected : joined T I.
Variable count : length E = (length T + 2)%nat.

(* Some triangles, whose sides not across pairs of J are the closed walk C. *)
Definition grown (T1 : list (nat * nat * nat)) (C J : list (nat * nat)) : Prop := exists o, walk o C o /\
  Permutation (flat_map sides T1) (C ++ flat_map both J) /\ length C = (length T1 + 2)%nat /\
  incl (flat_map both J) (flat_map both I).

Lemma grow_one T1 T2 C J : Permutation T (T1 ++ T2) -> T1 <> nil -> T2 <> nil -> grown T1 C J ->
  exists t T3 C' J', Permutation T ((t :: T1) ++ T3) /\ length T2 = S (length T3) /\ grown (t :: T1) C' J'.
Proof.
  intros S N1 N2 [o [W [P [L Inc]]]]. destruct (connected T1 T2 S N1 N2) as [a [b [Ib [F1 F2]]]].
  assert (Fresh : ~ In (b, a) (flat_map sides T1)).
  { intros F. pose proof (Permutation_NoDup (sides_permuted _ _ S) once) as D. rewrite flat_map_app in D.
    now apply (nodup_apart _ _ _ D F). }
  assert (Fc : In (a, b) C).
  { apply (Permutation_in _ P) in F1. apply in_app_or in F1 as [F | F]; [exact F |]. exfalso. apply Fresh.
    apply (Permutation_in _ (Permutation_sym P)), in_or_app. right. now apply both_back. }
  apply in_split in Fc as [C1 [C2 Hc]]. apply in_flat_map in F2 as [t [Ht F2]]. apply in_split in Ht as [Ta [Tb Ht]].
  destruct (turned_to t a b F2) as [c Pt].
  exists t, (Ta ++ Tb), (C1 ++ (a, c) :: (c, b) :: C2), ((a, b) :: J). split; [| split].
  - apply (Permutation_trans S). rewrite Ht. simpl. rewrite !app_assoc. symmetry. apply Permutation_middle.
  - rewrite Ht, !app_length. simpl. lia.
  - exists o. split; [| split; [| split]].
    + rewrite Hc in W. apply walk_app in W as [m [W1 [Em W2]]]. apply walk_app. exists m. now repeat split.
    + simpl flat_map. apply (Permutation_trans (Permutation_app Pt P)). rewrite Hc.
      apply (Permutation_count_occ pair_dec). intros e.
      repeat (progress simpl || rewrite count_occ_app). repeat destruct (pair_dec _ _); lia.
    + rewrite Hc in L. rewrite !app_length in *. simpl in *. lia.
    + intros e K. simpl in K. destruct K as [<- | [<- | K]]; [exact Ib | now apply both_back | now apply Inc].
Qed.

Lemma grow_all n : forall T1 T2 C J, length T2 = n -> Permutation T (T1 ++ T2) -> T1 <> nil -> grown T1 C J ->
  exists T' C' J', Permutation T T' /\ grown T' C' J'.
Proof.
  induction n as [| n IH]; intros T1 T2 C J L S N G.
  - apply length_zero_iff_nil in L. subst. rewrite app_nil_r in S. now exists T1, C, J.
  - destruct (grow_one T1 T2 C J S N ltac:(intros ->; discriminate) G) as [t [T3 [C' [J' [S' [L' G']]]]]].
    apply (IH (t :: T1) T3 C' J'); [lia | exact S' | discriminate | exact G'].
Qed.

(* The sides in an order in which they are a closed walk. *)
Theorem tree_one_walk : exists o C, walk o C o /\ Permutation E C.
Proof.
  assert (Some : exists t l, T = t :: l).
  { destruct T as [| t l] eqn:Et; [exfalso | now exists t, l]. apply Permutation_nil, app_eq_nil in rim as [-> _].
    discriminate count. }
  destruct Some as [t [l Et]].
  destruct (grow_all (length l) (t :: nil) l (sides t) nil eq_refl) as [T' [C [J [S [o [W [P [L Inc]]]]]]]].
  - rewrite Et. apply Permutation_refl.
  - discriminate.
  - destruct t as [[a b] c]. exists a. repeat split; try reflexivity. intros e [].
  - assert (Q : Permutation (C ++ flat_map both J) (E ++ flat_map both I)).
    { apply (Permutation_trans (Permutation_sym P)).
      apply (Permutation_trans (Permutation_sym (sides_permuted _ _ S))). exact rim. }
    pose proof (Permutation_NoDup rim once) as D. pose proof (Permutation_NoDup (Permutation_sym Q) D) as D'.
    assert (Inc' : incl (flat_map both I) (flat_map both J)).
    { apply NoDup_length_incl; [now apply nodup_right with C | | exact Inc].
      pose proof (Permutation_length Q) as K. rewrite !app_length in K. pose proof (Permutation_length S). lia. }
    assert (Same : forall e, In e E <-> In e C).
    { intros e. split; intros X.
      - assert (Y : In e (C ++ flat_map both J)) by (apply (Permutation_in _ (Permutation_sym Q)), in_or_app; now left).
        apply in_app_or in Y as [Y | Y]; [exact Y |]. exfalso. now apply (nodup_apart _ _ _ D X), Inc.
      - assert (Y : In e (E ++ flat_map both I)) by (apply (Permutation_in _ Q), in_or_app; now left).
        apply in_app_or in Y as [Y | Y]; [exact Y |]. exfalso. now apply (nodup_apart _ _ _ D' X), Inc'. }
    exists o, C. split; [exact W |]. apply NoDup_Permutation; [| | exact Same].
    + apply nodup_left with (flat_map both I). exact D.
    + apply nodup_left with (flat_map both J). exact D'.
Qed.

Theorem tree_one_cycle : one_cycle E.
Proof.
  destruct tree_one_walk as (o & C & W & P). intros K Step a b c d F G.
  apply (walk_one_cycle o C W); try (now apply (Permutation_in _ P)).
  intros u v w U V. apply Step; now apply (Permutation_in _ (Permutation_sym P)).
Qed.
End Tree.

(* At least three sides, out of different vertices: none is followed by its own way back. *)
Lemma cycle_goes_on E : one_cycle E -> NoDup (map fst E) -> (3 <= length E)%nat ->
  forall a b c, In (a, b) E -> In (b, c) E -> a <> c.
Proof.
  intros Cy D L a b c F G <-.
  assert (All : incl E ((a, b) :: (b, a) :: nil)).
  { intros [x y] H. apply (Cy (fun x y => In (x, y) ((a, b) :: (b, a) :: nil))) with a b; auto; [| now left].
    intros u v w U V [K | [K | []]]; injection K as <- <-;
      [rewrite (one_way_out E b w a D V G); right | rewrite (one_way_out E a w b D V F)]; now left. }
  pose proof (NoDup_incl_length (NoDup_map_inv fst E D) All) as K. simpl in K. lia.
Qed.

(* ---- ghost triangles ---- *)

(* The link of a ghost triangle, written with the ghost last. *)
Definition link_of (t : nat * nat * nat) : nat * nat := fst t.

Lemma walk_starts f F l : walk f F l -> map fst F ++ l :: nil = f :: map snd F.
Proof.
  revert f. induction F as [| [x y] F IH]; intros f W; simpl in *; [now subst |]. destruct W as [-> W].
  now rewrite (IH y W).
Qed.

Lemma walk_never f F l g e : walk f F l -> l <> g -> (forall b, ~ In (g, b) F) -> In e F -> snd e <> g.
Proof.
  revert f. induction F as [| [x y] F IH]; intros f W L N G; [destruct G |]. destruct W as [-> W].
  destruct G as [<- | G]; [| apply (IH y W L); [intros b K; apply (N b); now right | exact G]].
  simpl. intros ->. destruct F as [| [u v] F]; [now apply L |]. destruct W as [-> _]. apply (N v). right. now left.
Qed.

(* Ghost triangles joined like a tree, with t + 2 sides out of different vertices: their links are one way, whose ends
   are the two vertices joined with the ghost by sides that are not shared, and all its vertices are different. *)
Theorem ghosts_one_way T E I g : NoDup (flat_map sides T) -> Permutation (flat_map sides T) (E ++ flat_map both I) ->
  joined T I -> length E = (length T + 2)%nat -> NoDup (map fst E) ->
  (forall a b c, In (a, b, c) T -> c = g /\ a <> g /\ b <> g) ->
  exists f l F, walk f F l /\ Permutation E ((g, f) :: (l, g) :: F) /\ Permutation F (map link_of T) /\
    NoDup (f :: map snd F).
Proof.
  intros Once Rim Con Len Out Ghost. destruct (tree_one_walk T E I Once Rim Con Len) as (o & C & W & P).
  assert (DE : NoDup E) by (apply nodup_left with (flat_map both I), (Permutation_NoDup Rim Once)).
  assert (Link : forall e, In e E -> fst e <> g -> snd e <> g -> In e (map link_of T)).
  { intros [x y] F X Y. assert (G : In (x, y) (flat_map sides T)) by (apply (Permutation_in _ (Permutation_sym Rim)),
    in_or_app; now left).
    apply in_flat_map in G as [[[a b] c] [G S]]. destruct (Ghost a b c G) as [-> [A D]].
    simpl in S, X, Y. destruct S as [S | [S | [S | []]]]; injection S as <- <-; try contradiction.
    apply in_map_iff. now exists (a, b, g). }
  assert (Start : exists f, In (g, f) C).
  { apply NNPP. intros N. assert (N' : forall b, ~ In (g, b) C) by (intros b K; apply N; now exists b).
    assert (Og : o <> g).
    { intros ->. destruct C as [| [x y] C']; [apply Permutation_length in P; simpl in P; lia |]. destruct W as [-> _].
      apply (N' y). now left. }
    assert (Inc : incl E (map link_of T)).
    { intros e F. pose proof (Permutation_in _ P F) as K. apply Link; [exact F | |].
      - destruct e as [x y]. simpl. intros ->. now apply (N' y).
      - now apply (walk_never o C o g e W Og N'). }
    pose proof (NoDup_incl_length DE Inc) as L. rewrite map_length in L. lia. }
  destruct Start as [f G]. apply in_split in G as [C1 [C2 HC]]. rewrite HC in W.
  apply walk_app in W as [m [W1 [<- W2]]].
  assert (Round : walk f (C2 ++ C1) g) by (apply walk_app; now exists o).
  assert (PE : Permutation E ((g, f) :: C2 ++ C1)).
  { apply (Permutation_trans P). rewrite HC. apply (Permutation_trans (Permutation_app_comm _ _)).
    apply Permutation_refl. }
  assert (Df : NoDup (map fst ((g, f) :: C2 ++ C1))) by (apply (Permutation_NoDup (Permutation_map fst PE)), Out).
  assert (Long : C2 ++ C1 <> nil).
  { intros Z. rewrite Z in PE. apply Permutation_length in PE. simpl in PE. lia. }
  destruct (exists_last Long) as [F [[l g'] HF]]. rewrite HF in Round, PE, Df. clear HF Long.
  apply walk_app in Round as [l' [WF [-> ->]]]. exists f, l', F.
  assert (PE' : Permutation E ((g, f) :: (l', g) :: F)).
  { apply (Permutation_trans PE). apply perm_skip. apply Permutation_sym, Permutation_cons_append. }
  simpl in Df. inversion Df as [| ? ? Ng Dl]; subst. rewrite map_app in Ng, Dl. simpl in Ng, Dl.
  assert (Lg : l' <> g) by (intros ->; apply Ng, in_or_app; right; now left).
  assert (NF : forall b, ~ In (g, b) F).
  { intros b K. apply Ng, in_or_app. left. change g with (fst (g, b)). now apply in_map. }
  split; [exact WF |]. split; [exact PE' |]. split; [| now rewrite <- (walk_starts f F l' WF)].
  apply NoDup_Permutation_bis.
  - apply (NoDup_map_inv fst). now apply nodup_left with (l' :: nil).
  - apply Permutation_length in PE'. simpl in PE'. rewrite map_length. lia.
  - intros e K. apply Link.
    + apply (Permutation_in _ (Permutation_sym PE')). right. now right.
    + destruct e as [x y]. simpl. intros ->. now apply (NF y).
    + now apply (walk_never f F l' g e WF Lg NF).
Qed.

(* ---- tied faces ---- *)

(* A face of at least two triangles, whose sides are legal and out of different vertices, whose true points are on one
   circle: no other site is in the disc or on the circle, all pairs of its vertices are weakly Delaunay, and pairs that
   are not sides never strictly. *)
Theorem tied_polygon N B p q T E I o r : choice N B p -> choice N B q ->
  NoDup (flat_map sides T) -> Permutation (flat_map sides T) (E ++ flat_map both I) -> joined T I ->
  length E = (length T + 2)%nat -> (2 <= length T)%nat -> NoDup (map fst E) ->
  (forall a b c, In (a, b, c) T -> 0 < orient (p a) (p b) (p c) /\ forall m, (m < N)%nat -> ~ on_rim E m ->
    ~ (0 <= orient (p a) (p b) (p m) /\ 0 <= orient (p b) (p c) (p m) /\ 0 <= orient (p c) (p a) (p m))) ->
  (forall a b, In (a, b) E -> (a < N)%nat /\ (b < N)%nat /\ a <> b /\ legal N B a b) ->
  (forall v, on_rim E v -> dist o (q v) = r) ->
  (forall m, (m < N)%nat -> ~ on_rim E m -> r < dist o (q m)) /\
  forall i j, on_rim E i -> on_rim E j -> weak_edge N q i j /\
    (i <> j -> ~ In (i, j) E -> ~ In (j, i) E -> ~ strict_edge N q i j).
Proof.
  intros P Q Once Rim Con Len Two Out Skel Side Circ.
  pose proof (tree_one_cycle T E I Once Rim Con Len) as Cy.
  pose proof (cycle_goes_on E Cy Out ltac:(lia)) as Turn.
  assert (R : rim_of T E) by (now exists I).
  assert (V : exists v, on_rim E v).
  { destruct E as [| [a b] l]; [simpl in Len; lia |]. exists a, b. left. now left. }
  assert (R0 : 0 < r).
  { destruct V as [v [b F]]. assert (X : exists x y, In (x, y) E) by (destruct F; eauto). destruct X as [x [y X]].
    pose proof (Circ x ltac:(exists y; now left)) as Cx. pose proof (Circ y ltac:(exists x; now right)) as Cy'.
    pose proof (dist_nonneg o (q x)). apply Rnot_le_lt. intros L.
    apply (apart_ends N B q T E Q R Side Turn x y X). rewrite <- (dist_zero o (q x)) by lra.
    apply dist_zero. lra. }
  split; [| intros i j Vi Vj; split].
  - intros m M Nm. now apply (polygon_empty N B p q T E P Q R Skel Side Turn Cy o r Circ).
  - now apply (polygon_weak N B p q T E P Q R Skel Side Turn Cy o r Circ).
  - now apply (polygon_not_strict N B q T E Q R Side Turn o r Circ).
Qed.
