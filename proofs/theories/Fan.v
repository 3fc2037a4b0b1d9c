(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* When all faces round a site are triangles with legal edges, no other pair of that site is possible.
   The faces round the site a are a list of pairs (i,j): the triangles a, i, j, counterclockwise. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Disc Crossing Path.
Open Scope R_scope.

(* No third site is on a strictly Delaunay edge. *)
Lemma edge_is_free N p i j k : (k < N)%nat -> k <> i -> k <> j -> strict_edge N p i j -> ~ between (p k) (p i) (p j).
Proof.
  intros K Di Dj [o [E H]] [t [T Z]]. pose proof (H k K Di Dj) as L. rewrite Z in L.
  assert (X : dist o (mix t (p i) (p j)) <= dist o (p i)).
  { apply disc_convex; [exact T | lra | lra]. }
  lra.
Qed.

(* A sure hull vertex: beyond all others in some direction, for every choice. *)
Definition sure_hull (N : nat) (B : sites) (v : nat) : Prop :=
  exists u, forall k x y, (k < N)%nat -> k <> v -> inside x (B v) -> inside y (B k) -> dot u y < dot u x.

Lemma sure_hull_not_between N B p v a b : (v < N)%nat -> (a < N)%nat -> (b < N)%nat -> a <> v -> b <> v ->
  choice N B p -> sure_hull N B v -> ~ between (p v) (p a) (p b).
Proof.
  intros V A H Da Db P [u U] [t [T Z]]. pose proof (U a (p v) (p a) A Da (P v V) (P a A)).
  pose proof (U b (p v) (p b) H Db (P v V) (P b H)).
  assert (E : dot u (p v) = (1 - t) * dot u (p a) + t * dot u (p b)) by (rewrite Z; apply dot_mix).
  destruct (Req_dec t 0) as [-> | T0]; [lra |].
  assert (t * dot u (p b) < t * dot u (p v)) by (apply Rmult_lt_compat_l; lra).
  assert ((1 - t) * dot u (p a) <= (1 - t) * dot u (p v)) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(* The segment from a to b leaves the triangle a, i, j through its side ij. *)
Definition leaves (p : nat -> point) (a b i j : nat) : Prop :=
  0 <= orient (p a) (p i) (p b) /\ 0 <= orient (p a) (p b) (p j) /\ orient (p i) (p j) (p b) <= 0.

(* Barycentric coordinates with respect to a triangle, times its orientation. *)
Lemma bary_sum a i j b : orient i j b + orient a b j + orient a i b = orient a i j.
Proof. unfold orient. ring. Qed.

Lemma bary_x a i j b :
  orient a i j * fst b = orient i j b * fst a + orient a b j * fst i + orient a i b * fst j.
Proof. unfold orient. ring. Qed.

Lemma bary_y a i j b :
  orient a i j * snd b = orient i j b * snd a + orient a b j * snd i + orient a i b * snd j.
Proof. unfold orient. ring. Qed.

Lemma scaled_point_eq k x y : k <> 0 -> k * fst x = k * fst y -> k * snd x = k * snd y -> x = y.
Proof.
  intros K X Y. destruct x, y. simpl in *. f_equal; apply (Rmult_eq_reg_l k); assumption.
Qed.

Section Fan.
Variables (N : nat) (B : sites) (a b : nat) (faces : list (nat * nat)).
Variables (Ha : (a < N)%nat) (Hb : (b < N)%nat).

(* The three edges of each face are legal; b is not a vertex of it. *)
Definition legal_faces : Prop := forall i j, In (i, j) faces ->
  (i < N)%nat /\ (j < N)%nat /\ i <> a /\ j <> a /\ i <> j /\ b <> a /\ b <> i /\ b <> j /\
  legal N B a i /\ legal N B a j /\ legal N B i j.

(* The faces go all round a, or from one sure hull vertex to another. *)
Definition no_gap : Prop := forall i j, In (i, j) faces ->
  (sure_hull N B i \/ exists l, In (l, i) faces) /\ (sure_hull N B j \/ exists l, In (j, l) faces).

Definition all_left (p : nat -> point) : Prop := forall i j, In (i, j) faces -> 0 < orient (p a) (p i) (p j).
Definition leaves_some (p : nat -> point) : Prop := exists i j, In (i, j) faces /\ leaves p a b i j.

Variables (edges : legal_faces) (closed : no_gap).

Lemma face_not_flat p i j : choice N B p -> In (i, j) faces -> orient (p a) (p i) (p j) <> 0.
Proof.
  intros P F E. destruct (edges i j F) as [I [J [Da [Ja [Dij [_ [_ [_ [La [Lj Lij]]]]]]]]]].
  destruct (one_between _ _ _ E) as [X | [X | X]]; revert X; apply edge_is_free with N; auto.
  - now apply (legal_sound N B i j p).
  - now apply (legal_sound N B a j p).
  - now apply (legal_sound N B a i p).
Qed.

(* The path from one choice to another. *)
Definition path (p q : nat -> point) (t : R) (k : nat) : point := mix t (p k) (q k).

Lemma path_choice p q t : 0 <= t <= 1 -> choice N B p -> choice N B q -> choice N B (path p q t).
Proof. intros T P Q k K. apply inside_convex; [exact T | now apply P | now apply Q]. Qed.

Lemma path_0 p q k : path p q 0 k = p k.
Proof. apply mix_0. Qed.

Lemma path_1 p q k : path p q 1 k = q k.
Proof. apply mix_1. Qed.

Lemma path_orient_continuous p q i j k : continuity (fun t => orient (path p q t i) (path p q t j) (path p q t k)).
Proof. unfold path, orient, mix. simpl. reg. Qed.

(* Legal faces never turn over. *)
Lemma faces_stay_left p q : choice N B p -> choice N B q -> all_left p -> all_left q.
Proof.
  intros P Q L i j F. pose proof (L i j F) as X. apply Rnot_le_lt. intros Y.
  destruct (intermediate (fun t => - orient (path p q t a) (path p q t i) (path p q t j))) as [t [T E]].
  - apply (continuity_opp (fun t => orient (path p q t a) (path p q t i) (path p q t j))), path_orient_continuous.
  - rewrite !path_0. lra.
  - rewrite !path_1. lra.
  - apply (face_not_flat (path p q t) i j); [now apply path_choice | exact F | lra].
Qed.

(* b is not on the side ij, so it is strictly beyond. *)
Lemma strictly_beyond p i j : choice N B p -> all_left p -> In (i, j) faces -> leaves p a b i j ->
  orient (p i) (p j) (p b) < 0.
Proof.
  intros P L F [O1 [O2 O3]]. destruct (Req_dec (orient (p i) (p j) (p b)) 0) as [Z | Z]; [exfalso | lra].
  destruct (edges i j F) as [I [J [Da [Ja [Dij [Dba [Dbi [Dbj [La [Lj Lij]]]]]]]]]].
  pose proof (L i j F) as D. set (d := orient (p a) (p i) (p j)) in *.
  pose proof (bary_sum (p a) (p i) (p j) (p b)) as S. fold d in S.
  apply (edge_is_free N p i j b Hb Dbi Dbj (legal_sound N B i j p I J Lij P)).
  exists (orient (p a) (p i) (p b) / d). split.
  - split.
    + apply Rmult_le_pos; [exact O1 | left; now apply Rinv_0_lt_compat].
    + apply (Rmult_le_reg_r d); [exact D |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
  - pose proof (bary_x (p a) (p i) (p j) (p b)) as X. pose proof (bary_y (p a) (p i) (p j) (p b)) as Y. fold d in X, Y.
    apply (scaled_point_eq d); [lra | rewrite X | rewrite Y]; rewrite Z; unfold mix; simpl;
      replace (orient (p a) (p b) (p j)) with (d - orient (p a) (p i) (p b)) by lra; field; lra.
Qed.

(* b on the ray from a through i, beyond i: then i is between a and b. *)
Lemma ray_between_left p i j : choice N B p -> all_left p -> In (i, j) faces -> leaves p a b i j ->
  orient (p a) (p i) (p b) = 0 -> between (p i) (p a) (p b).
Proof.
  intros P L F H Z. pose proof (strictly_beyond p i j P L F H) as O. pose proof (L i j F) as D.
  set (d := orient (p a) (p i) (p j)) in *. set (o := orient (p i) (p j) (p b)) in *.
  pose proof (bary_sum (p a) (p i) (p j) (p b)) as S. fold d o in S.
  exists (d / (d - o)). assert (0 < / (d - o)) by (apply Rinv_0_lt_compat; lra). split.
  - split; [apply Rmult_le_pos; lra |]. apply (Rmult_le_reg_r (d - o)); [lra |].
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
  - pose proof (bary_x (p a) (p i) (p j) (p b)) as X. pose proof (bary_y (p a) (p i) (p j) (p b)) as Y.
    fold d o in X, Y. rewrite Z in X, Y. replace (orient (p a) (p b) (p j)) with (d - o) in X, Y by lra.
    apply (scaled_point_eq (d - o)); [lra | |]; unfold mix; simpl.
    + transitivity ((d - o) * fst (p a) - d * fst (p a) + d * fst (p b)); [rewrite X; ring | field; lra].
    + transitivity ((d - o) * snd (p a) - d * snd (p a) + d * snd (p b)); [rewrite Y; ring | field; lra].
Qed.

Lemma ray_between_right p i j : choice N B p -> all_left p -> In (i, j) faces -> leaves p a b i j ->
  orient (p a) (p b) (p j) = 0 -> between (p j) (p a) (p b).
Proof.
  intros P L F H Z. pose proof (strictly_beyond p i j P L F H) as O. pose proof (L i j F) as D.
  set (d := orient (p a) (p i) (p j)) in *. set (o := orient (p i) (p j) (p b)) in *.
  pose proof (bary_sum (p a) (p i) (p j) (p b)) as S. fold d o in S.
  exists (d / (d - o)). assert (0 < / (d - o)) by (apply Rinv_0_lt_compat; lra). split.
  - split; [apply Rmult_le_pos; lra |]. apply (Rmult_le_reg_r (d - o)); [lra |].
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
  - pose proof (bary_x (p a) (p i) (p j) (p b)) as X. pose proof (bary_y (p a) (p i) (p j) (p b)) as Y.
    fold d o in X, Y. rewrite Z in X, Y. replace (orient (p a) (p i) (p b)) with (d - o) in X, Y by lra.
    apply (scaled_point_eq (d - o)); [lra | |]; unfold mix; simpl.
    + transitivity ((d - o) * fst (p a) - d * fst (p a) + d * fst (p b)); [rewrite X; ring | field; lra].
    + transitivity ((d - o) * snd (p a) - d * snd (p a) + d * snd (p b)); [rewrite Y; ring | field; lra].
Qed.

(* Beside a ray of the fan the next face takes over. *)
Lemma next_left p i j l : choice N B p -> all_left p -> In (i, j) faces -> In (l, i) faces -> leaves p a b i j ->
  orient (p a) (p i) (p b) = 0 -> 0 < orient (p a) (p l) (p b) /\ orient (p l) (p i) (p b) < 0.
Proof.
  intros P L F G H Z. pose proof (strictly_beyond p i j P L F H) as O. pose proof (L i j F) as D.
  pose proof (L l i G) as D'. pose proof (bary_sum (p a) (p i) (p j) (p b)) as S.
  assert (E1 : orient (p a) (p i) (p j) * orient (p a) (p l) (p b) =
    orient (p a) (p b) (p j) * orient (p a) (p l) (p i) + orient (p a) (p i) (p b) * orient (p a) (p l) (p j))
    by (unfold orient; ring).
  assert (E2 : orient (p a) (p i) (p j) * orient (p l) (p i) (p b) =
    orient (p i) (p j) (p b) * orient (p a) (p l) (p i) + orient (p a) (p i) (p b) * orient (p l) (p i) (p j))
    by (unfold orient; ring).
  rewrite Z in *. set (d := orient (p a) (p i) (p j)) in *. set (o := orient (p i) (p j) (p b)) in *.
  assert (0 < orient (p a) (p b) (p j)) by lra. split.
  - apply (Rmult_lt_reg_l d); [exact D |]. rewrite E1. nra.
  - apply (Rmult_lt_reg_l d); [exact D |]. rewrite E2. nra.
Qed.

Lemma next_right p i j l : choice N B p -> all_left p -> In (i, j) faces -> In (j, l) faces -> leaves p a b i j ->
  orient (p a) (p b) (p j) = 0 -> 0 < orient (p a) (p b) (p l) /\ orient (p j) (p l) (p b) < 0.
Proof.
  intros P L F G H Z. pose proof (strictly_beyond p i j P L F H) as O. pose proof (L i j F) as D.
  pose proof (L j l G) as D'. pose proof (bary_sum (p a) (p i) (p j) (p b)) as S.
  assert (E1 : orient (p a) (p i) (p j) * orient (p a) (p b) (p l) =
    orient (p a) (p b) (p j) * orient (p a) (p i) (p l) + orient (p a) (p i) (p b) * orient (p a) (p j) (p l))
    by (unfold orient; ring).
  assert (E2 : orient (p a) (p i) (p j) * orient (p j) (p l) (p b) =
    orient (p i) (p j) (p b) * orient (p a) (p j) (p l) + orient (p a) (p b) (p j) * orient (p j) (p l) (p i))
    by (unfold orient; ring).
  rewrite Z in *. set (d := orient (p a) (p i) (p j)) in *. set (o := orient (p i) (p j) (p b)) in *.
  assert (0 < orient (p a) (p i) (p b)) by lra. split.
  - apply (Rmult_lt_reg_l d); [exact D |]. rewrite E1. nra.
  - apply (Rmult_lt_reg_l d); [exact D |]. rewrite E2. nra.
Qed.

Section Along.
Variables (p q : nat -> point) (P : choice N B p) (Q : choice N B q) (L : all_left p).
Let at_ (t : R) := path p q t.

Lemma choice_at t : 0 <= t <= 1 -> choice N B (at_ t).
Proof. intros T. now apply path_choice. Qed.

Lemma left_at t : 0 <= t <= 1 -> all_left (at_ t).
Proof. intros T. apply faces_stay_left with p; [exact P | now apply choice_at | exact L]. Qed.

(* Near a place where the segment leaves through ij, orient a i b stays positive, or the face before takes over. *)
Lemma near_left t i j : 0 <= t <= 1 -> In (i, j) faces -> leaves (at_ t) a b i j ->
  near t (fun s => 0 <= orient (at_ s a) (at_ s i) (at_ s b) \/
    exists l, In (l, i) faces /\ leaves (at_ s) a b l i).
Proof.
  intros T F H. pose proof (choice_at t T) as C. pose proof (left_at t T) as D.
  destruct (edges i j F) as [I [_ [Da [_ [_ [_ [Dbi _]]]]]]]. pose proof H as [O1 _].
  destruct (Req_dec (orient (at_ t a) (at_ t i) (at_ t b)) 0) as [Z | Z].
  - destruct (closed i j F) as [[S | [l G]] _].
    + exfalso. apply (sure_hull_not_between N B (at_ t) i a b); auto. now apply (ray_between_left (at_ t) i j).
    + destruct (next_left (at_ t) i j l C D F G H Z) as [X Y].
      pose proof (near_and _ _ _ (near_positive _ t (path_orient_continuous p q a l b) X)
        (near_negative _ t (path_orient_continuous p q l i b) Y)) as K.
      revert K. apply near_weaken. intros s [X' Y'].
      destruct (Rle_dec 0 (orient (at_ s a) (at_ s i) (at_ s b))) as [W | W]; [now left | right].
      exists l. split; [exact G |]. unfold at_ in *. split; [lra |]. split; [| lra]. rewrite orient_swap. lra.
  - pose proof (near_positive _ t (path_orient_continuous p q a i b)) as K. unfold at_ in *.
    assert (K' := K ltac:(lra)). revert K'. apply near_weaken. intros s W. left. lra.
Qed.

Lemma near_right t i j : 0 <= t <= 1 -> In (i, j) faces -> leaves (at_ t) a b i j ->
  near t (fun s => 0 <= orient (at_ s a) (at_ s b) (at_ s j) \/
    exists l, In (j, l) faces /\ leaves (at_ s) a b j l).
Proof.
  intros T F H. pose proof (choice_at t T) as C. pose proof (left_at t T) as D.
  destruct (edges i j F) as [_ [J [_ [Ja [_ [_ [_ [Dbj _]]]]]]]]. pose proof H as [_ [O2 _]].
  destruct (Req_dec (orient (at_ t a) (at_ t b) (at_ t j)) 0) as [Z | Z].
  - destruct (closed i j F) as [_ [S | [l G]]].
    + exfalso. apply (sure_hull_not_between N B (at_ t) j a b); auto. now apply (ray_between_right (at_ t) i j).
    + destruct (next_right (at_ t) i j l C D F G H Z) as [X Y].
      pose proof (near_and _ _ _ (near_positive _ t (path_orient_continuous p q a b l) X)
        (near_negative _ t (path_orient_continuous p q j l b) Y)) as K.
      revert K. apply near_weaken. intros s [X' Y'].
      destruct (Rle_dec 0 (orient (at_ s a) (at_ s b) (at_ s j))) as [W | W]; [now left | right].
      exists l. split; [exact G |]. unfold at_ in *. split; [rewrite orient_swap; lra |]. split; lra.
  - pose proof (near_positive _ t (path_orient_continuous p q a b j)) as K. unfold at_ in *.
    assert (K' := K ltac:(lra)). revert K'. apply near_weaken. intros s W. left. lra.
Qed.

Lemma leaving_is_open t : 0 <= t <= 1 -> leaves_some (at_ t) -> near t (fun s => leaves_some (at_ s)).
Proof.
  intros T [i [j [F H]]].
  pose proof (strictly_beyond (at_ t) i j (choice_at t T) (left_at t T) F H) as O.
  pose proof (near_and _ _ _ (near_and _ _ _ (near_left t i j T F H) (near_right t i j T F H))
    (near_negative _ t (path_orient_continuous p q i j b) O)) as K.
  revert K. apply near_weaken. intros s [[[X | [l [G X]]] [Y | [m [G' Y]]]] W].
  - exists i, j. split; [exact F |]. unfold at_ in *. split; [exact X |]. split; [exact Y | lra].
  - now exists j, m.
  - now exists l, i.
  - now exists l, i.
Qed.

Lemma not_leaving_is_open t : ~ leaves_some (at_ t) -> near t (fun s => ~ leaves_some (at_ s)).
Proof.
  intros H.
  assert (K : near t (fun s => forall f, In f faces -> ~ leaves (at_ s) a b (fst f) (snd f))).
  { apply near_list. intros [i j] F. simpl.
    assert (M : ~ leaves (at_ t) a b i j) by (intros M; apply H; now exists i, j).
    destruct (Rle_dec 0 (orient (at_ t a) (at_ t i) (at_ t b))) as [O1 | O1].
    - destruct (Rle_dec 0 (orient (at_ t a) (at_ t b) (at_ t j))) as [O2 | O2].
      + assert (O3 : 0 < orient (at_ t i) (at_ t j) (at_ t b)).
        { apply Rnot_le_lt. intros O3. apply M. now repeat split. }
        pose proof (near_positive _ t (path_orient_continuous p q i j b) O3) as K.
        revert K. apply near_weaken. intros s W [_ [_ X]]. unfold at_ in *. lra.
      + apply Rnot_le_lt in O2. pose proof (near_negative _ t (path_orient_continuous p q a b j) O2) as K.
        revert K. apply near_weaken. intros s W [_ [X _]]. unfold at_ in *. lra.
    - apply Rnot_le_lt in O1. pose proof (near_negative _ t (path_orient_continuous p q a i b) O1) as K.
      revert K. apply near_weaken. intros s W [X _]. unfold at_ in *. lra. }
  revert K. apply near_weaken. intros s W [i [j [F X]]]. now apply (W (i, j)).
Qed.

Lemma same_points u v : (forall k, u k = v k) -> leaves_some u -> leaves_some v.
Proof.
  intros E [i [j [F [X [Y Z]]]]]. exists i, j. split; [exact F |]. unfold leaves. rewrite <- !E. now repeat split.
Qed.

(* If the segment ab leaves through a face's side for one choice, it does for every choice. *)
Lemma leaving_persists : leaves_some p -> leaves_some q.
Proof.
  intros H. apply (same_points (at_ 1)); [apply path_1 |].
  apply (open_closed (fun t => leaves_some (at_ t))).
  - apply (same_points p); [intros k; symmetry; apply path_0 | exact H].
  - intros t T X. destruct (leaving_is_open t T X) as [e [E G]]. exists e. split; [exact E |]. intros s S _. now apply G.
  - intros t T X. destruct (not_leaving_is_open t X) as [e [E G]]. exists e. split; [exact E |]. intros s S _. now apply G.
Qed.
End Along.

(* Where the segment ab meets ij. *)
Lemma meets_side p i j : all_left p -> In (i, j) faces -> leaves p a b i j -> orient (p i) (p j) (p b) < 0 ->
  exists s t, 0 <= s <= 1 /\ 0 <= t <= 1 /\ mix s (p i) (p j) = mix t (p a) (p b) /\
    (s = 0 -> orient (p a) (p i) (p b) = 0) /\ (s = 1 -> orient (p a) (p b) (p j) = 0).
Proof.
  intros L F [O1 [O2 _]] O3. pose proof (L i j F) as D. pose proof (bary_sum (p a) (p i) (p j) (p b)) as S.
  pose proof (bary_x (p a) (p i) (p j) (p b)) as X. pose proof (bary_y (p a) (p i) (p j) (p b)) as Y.
  set (d := orient (p a) (p i) (p j)) in *. set (o := orient (p i) (p j) (p b)) in *.
  set (u := orient (p a) (p b) (p j)) in *. set (v := orient (p a) (p i) (p b)) in *.
  assert (W : u + v = d - o) by lra. assert (I : 0 < / (d - o)) by (apply Rinv_0_lt_compat; lra).
  exists (v / (d - o)), (d / (d - o)). split; [| split; [| split; [| split]]].
  - split; [apply Rmult_le_pos; lra |]. apply (Rmult_le_reg_r (d - o)); [lra |].
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
  - split; [apply Rmult_le_pos; lra |]. apply (Rmult_le_reg_r (d - o)); [lra |].
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
  - apply (scaled_point_eq (d - o)); [lra | |]; unfold mix; simpl.
    + transitivity ((d - o - v) * fst (p i) + v * fst (p j)); [field; lra |].
      transitivity (- o * fst (p a) + d * fst (p b)); [rewrite X; replace (d - o - v) with u by lra; ring | field; lra].
    + transitivity ((d - o - v) * snd (p i) + v * snd (p j)); [field; lra |].
      transitivity (- o * snd (p a) + d * snd (p b)); [rewrite Y; replace (d - o - v) with u by lra; ring | field; lra].
  - intros Z. apply (Rmult_eq_reg_r (/ (d - o))); [| lra]. unfold Rdiv in Z. lra.
  - intros Z. assert (v = d - o); [| lra].
    apply (Rmult_eq_reg_r (/ (d - o))); [| lra]. rewrite Rinv_r by lra. exact Z.
Qed.

(* Values of an affine function that vanishes at a and b, along the ray from a. *)
Lemma affine_beside g x y z w : ca g = 0 -> value g x = 0 -> value g y = 0 ->
  orient x y z * value g w = orient x y w * value g z.
Proof.
  intros C0 X Y.
  assert (E : orient x y z * value g w =
    orient x y w * value g z + (orient w y z) * value g x + orient x w z * value g y).
  { unfold value, orient. rewrite C0. ring. }
  rewrite E, X, Y. ring.
Qed.

Lemma half_plane_flat g x y z : ca g = 0 -> (ca g <> 0 \/ cb g <> 0 \/ cc g <> 0) ->
  value g x = 0 -> value g y = 0 -> value g z = 0 -> orient x y z = 0.
Proof.
  intros C0 G X Y Z. unfold value in X, Y, Z. rewrite C0 in X, Y, Z.
  apply (collinear (cb g, cc g)).
  - intros E. injection E as E E'. destruct G as [G | [G | G]]; congruence.
  - unfold dot. simpl. lra.
  - unfold dot. simpl. lra.
Qed.

(* For one choice: what leaves through ij is no edge where the next face begins on each side, or b is not on its line. *)
Lemma leaving_is_no_edge q i j : all_left q -> (forall k l, In (k, l) faces -> (k < N)%nat /\ (l < N)%nat) ->
  In (i, j) faces -> leaves q a b i j -> orient (q i) (q j) (q b) < 0 ->
  (forall s t, 0 <= s <= 1 -> 0 <= t <= 1 -> mix s (q i) (q j) = mix t (q a) (q b) ->
    forall g, supports N q a b g -> ca g = 0 /\ (1 - s) * value g (q i) + s * value g (q j) = 0) ->
  ((exists l, In (l, i) faces) \/ orient (q a) (q i) (q b) <> 0) ->
  ((exists l, In (j, l) faces) \/ orient (q a) (q b) (q j) <> 0) -> ~ weak_edge N q a b.
Proof.
  intros L Sites F H O Meet Before After W. pose proof (L i j F) as D. destruct (Sites i j F) as [I J].
  destruct (meets_side q i j L F H O) as [s [t [S [T [Z [Z0 Z1]]]]]].
  destruct (weak_edge_supported N q a b Ha Hb W) as [g G].
  destruct (Meet s t S T Z g G) as [C0 E].
  destruct G as [_ [G1 [Va [Vb Vk]]]]. pose proof (Vk i I) as Vi. pose proof (Vk j J) as Vj.
  destruct (Req_dec s 0) as [S0 | S0]; [| destruct (Req_dec s 1) as [S1 | S1]].
  - subst s. assert (Ei : value g (q i) = 0) by lra. specialize (Z0 eq_refl).
    destruct Before as [[l K] | K]; [| contradiction].
    destruct (Sites l i K) as [Hl _]. pose proof (Vk l Hl) as Vl. pose proof (L l i K) as D'.
    pose proof (affine_beside g (q a) (q i) (q j) (q l) C0 Va Ei) as M.
    rewrite (orient_swap (q a) (q l) (q i)) in M.
    assert (value g (q j) <> 0).
    { intros Ej. pose proof (half_plane_flat g _ _ _ C0 G1 Va Ei Ej). lra. }
    nra.
  - subst s. assert (Ej : value g (q j) = 0) by lra. specialize (Z1 eq_refl).
    destruct After as [[l K] | K]; [| contradiction].
    destruct (Sites j l K) as [_ Hl]. pose proof (Vk l Hl) as Vl. pose proof (L j l K) as D'.
    pose proof (affine_beside g (q a) (q j) (q i) (q l) C0 Va Ej) as M.
    rewrite (orient_swap (q a) (q i) (q j)) in M.
    assert (value g (q i) <> 0).
    { intros Ei. pose proof (half_plane_flat g _ _ _ C0 G1 Va Ei Ej). lra. }
    nra.
  - assert (Ei : value g (q i) = 0) by nra. assert (Ej : value g (q j) = 0) by nra.
    pose proof (half_plane_flat g _ _ _ C0 G1 Va Ei Ej). lra.
Qed.

Lemma leaving_refutes q i j : choice N B q -> all_left q -> In (i, j) faces -> leaves q a b i j -> ~ weak_edge N q a b.
Proof.
  intros Q L F H. destruct (edges i j F) as [I [J [Da [Ja [Dij [Dba [Dbi [Dbj [La [Lj Lij]]]]]]]]]].
  apply (leaving_is_no_edge q i j L); try assumption.
  - intros k l K. destruct (edges k l K) as [Hk [Hl _]]. now split.
  - now apply strictly_beyond.
  - intros s t S T Z. apply (meeting_edges N q i j a b s t); auto. now apply (legal_sound N B i j q).
  - destruct (closed i j F) as [[K | K] _]; [right | now left]. intros Z.
    apply (sure_hull_not_between N B q i a b); auto. now apply (ray_between_left q i j).
  - destruct (closed i j F) as [_ [K | K]]; [right | now left]. intros Z.
    apply (sure_hull_not_between N B q j a b); auto. now apply (ray_between_right q i j).
Qed.

(* The theorem: the faces round a are triangles with legal edges, without a gap; for one choice (the skeleton) they are
   counterclockwise and the segment from a to b leaves through one of them. Then ab is possible for no choice. *)
Theorem rest_is_illegal p : choice N B p -> all_left p -> leaves_some p -> ~ possible N B a b.
Proof.
  intros P L H X. apply (possible_exact N B a b Ha Hb) in X as [q [Q W]].
  destruct (leaving_persists p q P Q L H) as [i [j [F M]]].
  apply (leaving_refutes q i j Q (faces_stay_left p q P Q L) F M W).
Qed.
End Fan.
